#include "benchmark/contact/exact_motions.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/let_go.h"
#include "benchmark/contact/processor_time.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double g = 9.81, mu = 0.4, bounce = 0.7, radius = 0.05;  // m/s², –, –, m
constexpr double speed = 1.5, drop = 0.5;                          // m/s, m
constexpr double held = 0.04, sample_time = 0.02;                  // s
constexpr double slab_height = 0.1, slab_width = 8.0;              // m
constexpr double slab_mass = 1e6;                                  // kg

/// A motion after the release of an object. `exact`: its pose, computed from pose and twist at t = 0.
struct Motion {
  std::string name;
  geometry::Geometry geometry;
  double above = 0.0;  ///< height of the centre above the support [m]
  Vector3d v, w;
  double duration = 0.0, restitution = 0.0;
  std::function<RigidTransform(const RigidTransform& X0, const Twist& V0, double t)> exact;
};

RigidTransform moved_by(const RigidTransform& X0, const Vector3d& d) {
  RigidTransform X = X0;
  X.translation() += d;
  return X;
}

RigidTransform tumbling(const RigidTransform& X0, const Vector3d& v, const Vector3d& w, double across, double along,
                        double t) {
  // About an axis of symmetry: the body turns about its angular momentum, and about its own axis in it.
  const Matrix3d R0 = X0.linear();
  const Vector3d w_O = R0.transpose() * w;
  const Vector3d L_W = R0 * Vector3d(across * w_O.x(), across * w_O.y(), along * w_O.z());
  RigidTransform X = moved_by(X0, t * v - 0.5 * g * t * t * Vector3d::UnitZ());
  X.linear() =
      math::exp_so3(t / across * L_W) * R0 * math::exp_so3(t * w_O.z() * (1.0 - along / across) * Vector3d::UnitZ());
  return X;
}

std::vector<Motion> motions() {
  const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ();
  const auto slides = [x](const RigidTransform& X0, const Twist& V0, double t) {
    const double v = V0.linear.x();
    const double u = std::min(t, v / (mu * g));
    return moved_by(X0, (v * u - 0.5 * mu * g * u * u) * x);
  };
  const auto rolls = [x](const RigidTransform& X0, const Twist& V0, double t) {
    const double v = V0.linear.x();
    const double grip = 2.0 * v / (7.0 * mu * g), u = std::min(t, grip);
    return moved_by(X0, (v * u - 0.5 * mu * g * u * u + 5.0 / 7.0 * v * std::max(0.0, t - grip)) * x);
  };
  const auto bounces = [z](const RigidTransform& X0, const Twist&, double t) {
    double left = t - std::sqrt(2.0 * drop / g), v = bounce * std::sqrt(2.0 * g * drop);
    if (left < 0.0) return moved_by(X0, -0.5 * g * t * t * z);
    for (; left > 2.0 * v / g; v *= bounce) left -= 2.0 * v / g;
    return moved_by(X0, (-drop + v * left - 0.5 * g * left * left) * z);
  };
  const Vector3d prism(0.1, 0.1, 0.02), v(0.5, 0.2, 2.0), w(3.0, -4.0, 8.0);
  const Vector3d inertia = box_inertia(1.0, prism);
  const auto flies = [inertia](const RigidTransform& X0, const Twist& V0, double t) {
    return tumbling(X0, V0.linear, V0.angular, inertia.x(), inertia.z(), t);
  };
  const Vector3d none = Vector3d::Zero();
  return {{"slides and stops", geometry::Box{Vector3d::Constant(0.1)}, 0.05, speed * x, none, 0.6, 0.0, slides},
          {"slips and rolls", geometry::Sphere{radius}, radius, speed * x, none, 0.6, 0.0, rolls},
          {"bounces", geometry::Sphere{radius}, radius + drop, none, none, 1.2, bounce, bounces},
          {"flies", geometry::Box{prism}, 0.5, v, w, 0.4, 0.0, flies}};
}

scene::Scene scene_of(const Motion& motion, scene::ContactMode contact) {
  const double floor = contact == scene::ContactMode::dynamic ? slab_height : 0.0;
  RigidTransform X_WO = at(Vector3d(0.0, 0.0, floor + motion.above) - held * motion.v);
  X_WO.linear() = math::exp_so3(-held * motion.w);
  std::vector<scene::Body> bodies{uniform("held", motion.geometry, X_WO, mu, 1.0)};
  if (floor > 0.0) {
    bodies.push_back(box("slab", {slab_width, slab_width, slab_height}, slab_mass, {0.0, 0.0, 0.5 * floor}, mu));
  }
  scene::Scene scene = scene_with("motion", contact, std::move(bodies), mu);
  scene.bench_material.restitution = motion.restitution;
  for (scene::Body& body : scene.bodies) body.material.restitution = motion.restitution;
  return scene;
}

MotionRun run(const Motion& motion, scene::ContactMode contact, double step) {
  const scene::Scene scene = scene_of(motion, contact);
  simulation::Simulation s = let_go(scene, step, held, motion.v, motion.w);
  const RigidTransform X0 = s.objects()[0].X_WO;
  const Twist V0 = s.objects()[0].V_WO_W;
  const PairDepth depth(scene);
  MotionRun ended;
  ended.duration = motion.duration;
  ended.measured.to_the_end = true;
  for (int i = 1; i * sample_time < motion.duration + 1e-9; ++i) {
    const double begin = processor_time();
    const simulation::AdvanceReport report = s.advance_to(held + i * sample_time);
    const double spent = processor_time() - begin;
    ended.processor_time += spent;
    Measured& m = ended.measured;
    m.steps_blocked += report.steps_blocked;
    m.time_lost += report.time_lost;
    m.steps_rejected += report.steps_rejected;
    m.cpu_mean += (spent - m.cpu_mean) / i;
    m.cpu_99 = m.cpu_most = std::max(m.cpu_most, spent);
    ++m.looks;
    std::vector<RigidTransform> poses;
    for (const bodies::BodyState& o : s.objects()) poses.push_back(o.X_WO);
    const DeepestPair deepest = depth.deepest(poses);
    if (deepest.depth > m.deepest.depth) m.deepest = deepest;
    const RigidTransform exact = motion.exact(X0, V0, i * sample_time);
    ended.error = std::max(ended.error, (poses[0].translation() - exact.translation()).norm());
    // The end of an edge, so that orientation counts; for a sphere it does not.
    if (motion.name == "flies") {
      const Vector3d p(0.05, 0.05, 0.01);
      ended.error = std::max(ended.error, (poses[0] * p - exact * p).norm());
    }
    ended.displacement = std::max(ended.displacement, (exact.translation() - X0.translation()).norm());
  }
  return ended;
}

}  // namespace

std::vector<std::string> motions_in_contact() {
  std::vector<std::string> names;
  for (const Motion& motion : motions()) {
    if (motion.name != "flies") names.push_back(motion.name);
  }
  return names;
}

MotionRun run_motion(const std::string& name, scene::ContactMode contact, double step) {
  const std::vector<Motion> all = motions();
  return run(*std::find_if(all.begin(), all.end(), [&](const Motion& m) { return m.name == name; }), contact, step);
}

void run_motions(bool quick, const TakeRow& take) {
  std::vector<double> steps{0.02, 0.01, 0.005, 0.0025, 0.00125};
  if (quick) steps.resize(2);
  for (const scene::ContactMode contact : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    for (const Motion& motion : motions()) {
      std::vector<double> errors;
      TrialRow row{"motion", motion.name, name_of(contact), 0.005, {}, {}};
      double displacement = 0.0;
      for (const double step : steps) {
        const MotionRun ended = run(motion, contact, step);
        errors.push_back(ended.error);
        displacement = ended.displacement;
        if (step == row.step || quick) row.measured = ended.measured;
      }
      const double halvings = static_cast<double>(errors.size() - 1);
      row.bars = {at_least("order", std::log2(errors.front() / errors.back()) / halvings, 1.8)};
      if (errors.front() < 1e-6 * displacement) row.bars.clear();  // nothing left to converge
      if (!quick) {
        row.bars.push_back(at_most("at 5 ms", 100.0 * errors[2] / displacement, 0.01, "% of the way"));
        row.bars.push_back(at_most("at 1.25 ms", errors.back() / displacement, 1e-5, "of the way"));
      }
      row.bars.push_back(depth_bar(row.measured));
      row.bars.push_back(blocked_bar(row.measured));
      take(row);
    }
  }
}

ContactTrial incline(bool hull, scene::ContactMode contact, double off, double duration) {
  constexpr double friction = 0.5, half_ramp = 0.1, half_high = 0.025;  // –, m
  const Matrix3d R = Eigen::AngleAxisd(std::atan(friction) + off, Vector3d::UnitY()).toRotationMatrix();
  RigidTransform X_WR = at({0.0, 0.0, 15.0});
  X_WR.linear() = R;  // downhill is +x
  const RigidTransform X_WO = X_WR * at({0.0, 0.0, half_ramp + half_high + 1e-6});
  const geometry::Geometry shape = hull ? geometry::Geometry(prism(std::vector<double>(6, 0.06), 2.0 * half_high))
                                        : geometry::Geometry(geometry::Box{{0.1, 0.1, 2.0 * half_high}});
  ContactTrial trial;
  trial.trial = "incline";
  trial.name = std::string(hull ? "hull" : "box") + (off < 0.0 ? " below" : " above") + " the angle of friction";
  trial.scene = scene_with("incline", contact,
                           {standing("ramp", geometry::Box{{40.0, 1.0, 2.0 * half_ramp}}, X_WR, friction),
                            uniform("slider", shape, X_WO, friction, 1.0)},
                           friction);
  trial.settings = settings_with(0.0, 0.0, 0.02, "");
  trial.settings.fork.shape = rod::ShapeKind::bushing;  // the fork has no effect here
  const double length = trial.settings.fork.length;
  trial.X_WH = [=](double) { return hand_above(X_WO.translation(), length); };
  trial.woken_until = off < 0.0 ? duration : sample_time;
  trial.rests_from = 0.0;
  trial.duration = duration;
  return trial;
}

void run_inclines(bool quick, const TakeRow& take) {
  for (const double off : {-0.1 * M_PI / 180.0, 0.1 * M_PI / 180.0}) {
    for (const scene::ContactMode contact : {scene::ContactMode::stop, scene::ContactMode::dynamic}) {
      for (const bool hull : {false, true}) {
        const double duration = off < 0.0 && !quick ? 60.0 : quick ? 1.0 : 5.0;
        TrialRun run(incline(hull, contact, off, duration));
        int asleep = 0;
        bodies::BodyState first;  // after the first release
        for (bool more = true; more;) {
          more = run.advance();
          const bodies::BodyState& now = run.simulation().objects()[0];
          asleep += run.time() > 0.1 && now.asleep ? 1 : 0;
          if (run.time() < 0.05) first = now;
        }
        const double slid = (run.pose("slider").translation() - first.X_WO.translation()).norm();
        const Measured m = run.measured();
        std::vector<Bar> bars;
        if (off < 0.0) {
          bars.push_back(at_most("moved", 1e6 * slid, 10.0, "µm"));
          bars.push_back(at_most("steps asleep", asleep, 0.0));
        } else {
          const double angle = std::atan(0.5) + off, a = g * (std::sin(angle) - 0.5 * std::cos(angle));
          const double left = duration - 0.04, displacement = first.V_WO_W.linear.norm() * left + 0.5 * a * left * left;
          bars.push_back(at_most("way off the exact one", 100.0 * std::abs(slid / displacement - 1.0), 1.0, "%"));
        }
        bars.push_back(depth_bar(m));
        bars.push_back(blocked_bar(m));
        take(run.row(std::move(bars)));
      }
    }
  }
}

}  // namespace spring_workbench::benchmark
