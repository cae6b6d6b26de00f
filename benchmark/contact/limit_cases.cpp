#include "benchmark/contact/limit_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "benchmark/contact/bodies.h"
#include "spring_workbench/geometry/box_gap.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double g = 9.81, edge = 0.1, thin = 0.05;           // m/s², m, m
constexpr double pressing = 0.1, shifting = 0.1, rest = 0.2;  // s, of the hand
constexpr double farthest = 0.5;                              // m
constexpr double sample_time = 0.02;                          // s

/// The first body is the held one.
struct Setting {
  std::vector<scene::Body> bodies;
  Vector3d pressed, shifted;  // the two displacements of the hand
};

scene::Body cube(const std::string& name, double mass, const Vector3d& p_WO) {
  return box(name, Vector3d::Constant(edge), mass, p_WO);
}

/// A wall whose face towards −x is at `x`.
scene::Body wall(double x) {
  const Vector3d size(0.02, 1.0, 1.0);
  return standing("wall", geometry::Box{size}, at(Vector3d(x + 0.5 * size.x(), 0.0, 0.5)), 0.5);
}

Setting one_on_other(double upper, double lower) {
  return {{cube("held", upper, {0.02, 0, 1.5 * edge + 0.01}), cube("lower", lower, {0, 0, 0.5 * edge})},
          {0, 0, -0.03},
          {0.02, 0, 0}};
}

Setting at_wall(double mass) {
  return {{cube("held", mass, {0, 0, 0.5 * edge}), wall(0.5 * edge + 0.01)}, {0.03, 0, 0}, {0, 0.05, 0}};
}

Setting stack() {
  Setting s{{}, {0, 0, -0.02}, {0.01, 0, 0}};
  const auto on = [](int below) { return Vector3d(0, 0, (below + 0.5) * thin); };
  s.bodies.push_back(box("held", {edge, edge, thin}, 1.0, on(9) + Vector3d(0, 0, 0.01)));
  for (int i = 0; i < 9; ++i) s.bodies.push_back(box("box" + std::to_string(i), {edge, edge, thin}, 1.0, on(i)));
  return s;
}

Setting among_others() {
  return {{cube("held", 0.5, {0, 0, 0.5 * edge}), wall(0.5 * edge), cube("neighbour", 0.5, {-edge, 0, 0.5 * edge})},
          {0.02, 0.02, 0},
          {0, 0, 0.05}};
}

Setting under_another() {
  Setting s = among_others();
  s.bodies.push_back(box("on top", {edge, edge, thin}, 0.2, {0, 0, edge + 0.5 * thin}));
  return s;
}

Setting setting_of(ContactLimitCase limit_case) {
  switch (limit_case) {
    case ContactLimitCase::stack_of_ten:
      return stack();
    case ContactLimitCase::light_on_heavy:
      return one_on_other(1e-3, 1.0);
    case ContactLimitCase::heavy_on_light:
      return one_on_other(1.0, 1e-3);
    case ContactLimitCase::light_at_wall:
      return at_wall(1e-6);
    case ContactLimitCase::heavy_at_wall:
      return at_wall(1e6);
    case ContactLimitCase::massless_at_wall:
      return at_wall(0.0);
    case ContactLimitCase::grasped_touching:
      return among_others();
    case ContactLimitCase::grasped_under_another:
      return under_another();
  }
  throw std::logic_error("an limit_case without a scene");
}

scene::Scene scene_of(const LimitCaseCell& cell, const Setting& setting) {
  scene::Scene scene;
  scene.name = scene.path = name_of(cell.limit_case);
  scene.contact = cell.contact;
  scene.gravity = g;
  scene.bench_material.friction = 0.5;
  scene.bodies = setting.bodies;
  return scene;
}

simulation::SimulationSettings settings_of(const LimitCaseCell& cell) {
  simulation::SimulationSettings settings;
  settings.fork.stiffness = {cell.stiffness, cell.stiffness, 0.01 * cell.stiffness};
  settings.dynamics.step = cell.step;
  settings.grasp.object = "held";
  return settings;
}

double minimum_jerk(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

/// The hand, with the fork pointing down, initially above the held box.
class Hand {
 public:
  Hand(const LimitCaseCell& cell, const Setting& setting, double length)
      : pressed_(setting.pressed), shifted_(setting.shifted) {
    std::mt19937 random(cell.seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    start_ = setting.bodies[0].X_WO.translation() + Vector3d(0, 0, length);
    for (Vector3d* way : {&pressed_, &shifted_}) *way += 0.0025 * Vector3d(unit(random), unit(random), unit(random));
    turn_ = 0.05 * unit(random);
  }
  motion::PoseSample at(double t) const {
    const double in = minimum_jerk(t / pressing), along = minimum_jerk((t - pressing) / shifting);
    const Quaterniond down(0.0, 1.0, 0.0, 0.0);
    return {t, make_transform(start_ + in * pressed_ + along * shifted_,
                              Quaterniond(Eigen::AngleAxisd(along * turn_, Vector3d::UnitZ())) * down)};
  }

 private:
  Vector3d start_, pressed_, shifted_;
  double turn_;
};

class Watch {
 public:
  Watch(const simulation::Simulation& simulation) : simulation_(simulation), start_(simulation.objects()) {
    for (const scene::Body& body : simulation.scene().bodies) weight_ += body.mass_properties.mass * g;
    hardest_ = weight_;
  }

  /// Returns false if there is no point in continuing.
  bool look(bool at_rest, LimitCaseOutcome& outcome) {
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const bodies::BodyState& o = simulation_.objects()[i];
      outcome.finite =
          outcome.finite && o.X_WO.matrix().allFinite() && o.V_WO_W.linear.allFinite() && o.V_WO_W.angular.allFinite();
      const double way = (o.X_WO.translation() - start_[i].X_WO.translation()).norm();
      outcome.bounded = outcome.bounded && outcome.finite && way < farthest;
      if (!o.held) outcome.pushed = std::max(outcome.pushed, way);
    }
    if (!outcome.bounded) return false;
    outcome.penetration = std::max(outcome.penetration, depth());
    double force = 0.0;
    for (const contact::ContactState& contact : simulation_.contacts()) force += contact.force;
    hardest_ = std::max(hardest_, weight_ + force);
    if (!at_rest) return true;
    const double now = energy();
    const Vector3d handle = simulation_.tool().X_WH_proxy.translation();
    // A blocked object is pulled back to the hand, which is work of the hand.
    const double work = std::isfinite(lowest_) ? hardest_ * (handle - handle_).norm() : 0.0;
    lowest_ = std::min(lowest_ + work, now);
    handle_ = handle;
    growth_ = std::max(growth_, now - lowest_);
    outcome.energy_gained = growth_ > 0.0 ? growth_ / std::max(hardest_, 1e-9) : 0.0;
    return true;
  }

 private:
  double depth() const {
    std::vector<geometry::OutlineBox> boxes;
    const scene::Scene& scene = simulation_.scene();
    std::size_t object = 0;
    for (const scene::Body& body : scene.bodies) {
      const RigidTransform& X_WO = body.movable ? simulation_.objects()[object++].X_WO : body.X_WO;
      geometry::OutlineBox box = geometry::outline(body.collision).front();
      box.X = X_WO * box.X;
      boxes.push_back(box);
    }
    double gap = 0.0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (scene.bodies[i].movable) gap = std::min(gap, geometry::gap_above(boxes[i], scene.bench_height).gap);
      for (std::size_t j = 0; j < i; ++j) gap = std::min(gap, geometry::gap_between(boxes[i], boxes[j]).gap);
    }
    return -gap;
  }

  double energy() const {
    double sum = simulation_.tool().elastic_energy;
    std::size_t object = 0;
    for (const scene::Body& body : simulation_.scene().bodies) {
      if (!body.movable) continue;
      const bodies::BodyState& o = simulation_.objects()[object++];
      const Vector3d w_O = o.X_WO.linear().transpose() * o.V_WO_W.angular;
      const scene::MassProperties& m = body.mass_properties;
      sum += m.mass * (0.5 * o.V_WO_W.linear.squaredNorm() + g * o.X_WO.translation().z()) +
             0.5 * w_O.dot(m.inertia_O * w_O);
    }
    return sum;
  }

  const simulation::Simulation& simulation_;
  std::vector<bodies::BodyState> start_;
  double weight_ = 0.0, hardest_ = 0.0;
  Vector3d handle_ = Vector3d::Zero();  ///< proxy handle of the held object at the last call
  double lowest_ = std::numeric_limits<double>::infinity(), growth_ = 0.0;
};

}  // namespace

const std::vector<ContactLimitCase>& contact_limit_cases() {
  static const std::vector<ContactLimitCase> all{
      ContactLimitCase::stack_of_ten,     ContactLimitCase::light_on_heavy,       ContactLimitCase::heavy_on_light,
      ContactLimitCase::light_at_wall,    ContactLimitCase::heavy_at_wall,        ContactLimitCase::massless_at_wall,
      ContactLimitCase::grasped_touching, ContactLimitCase::grasped_under_another};
  return all;
}

std::string name_of(ContactLimitCase limit_case) {
  switch (limit_case) {
    case ContactLimitCase::stack_of_ten:
      return "stack of ten";
    case ContactLimitCase::light_on_heavy:
      return "1 g held on 1 kg";
    case ContactLimitCase::heavy_on_light:
      return "1 kg held on 1 g";
    case ContactLimitCase::light_at_wall:
      return "1e-6 kg at a wall";
    case ContactLimitCase::heavy_at_wall:
      return "1e6 kg at a wall";
    case ContactLimitCase::massless_at_wall:
      return "massless at a wall";
    case ContactLimitCase::grasped_touching:
      return "grasped while it touches";
    case ContactLimitCase::grasped_under_another:
      return "grasped under another";
  }
  throw std::logic_error("an limit_case without a name");
}

LimitCaseOutcome run(const LimitCaseCell& cell) {
  const Setting setting = setting_of(cell.limit_case);
  const simulation::SimulationSettings settings = settings_of(cell);
  simulation::Simulation simulation(scene_of(cell, setting), settings);
  const Hand hand(cell, setting, settings.fork.length);
  const double interval = std::max(cell.step, sample_time), end = pressing + shifting + rest;
  const int samples = static_cast<int>(std::lround(end / interval));
  for (int i = 0; i <= samples; ++i) simulation.push_stylus(hand.at(interval * i));
  Watch watch(simulation);
  LimitCaseOutcome outcome;
  for (int i = 1; i <= samples; ++i) {
    const simulation::AdvanceReport report = simulation.advance_to(interval * i);
    outcome.rejected += report.steps_rejected;
    outcome.steps_blocked += report.steps_blocked;
    outcome.steps_unsolved += report.steps_unsolved;
    if (!watch.look(interval * i > pressing + shifting + 1.5 * interval, outcome)) break;
  }
  return outcome;
}

}  // namespace spring_workbench::benchmark
