// The steps of a held body, at the limits of all that can be chosen.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "benchmark/energy_watch.h"
#include "fuzz/choices.h"
#include "fuzz/running.h"
#include "fuzz/targets.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"
#include "support/bodies.h"
#include "support/count_allocations.h"

namespace spring_workbench::fuzz {
namespace {

constexpr int kMaxSteps = 400;      // approximately, for a short run
constexpr int kMaxSamples = 60;     // of the hand
constexpr int kRests = 5;           // samples at the end
constexpr double kLongest = 0.1;    // s; of a step and between samples, except for a dropout
constexpr double kMoveTime = 0.02;  // s; in less, the hand moves less far
constexpr double kTremor = 0.051;   // m/s from sample to sample; more is a motion
constexpr double kPi = 3.1415926535897932384626433832795;

simulation::SimulationSettings chosen_settings(Choices& next) {
  simulation::SimulationSettings settings;
  settings.styluses = 1;
  settings.grasp.object = "object";
  settings.grasp.start_follow = true;
  settings.grasp.X_OE = RigidTransform(Eigen::Translation3d(0.03, 0.02, -0.05));
  rod::ForkSettings& fork = settings.fork;
  fork.shape = static_cast<rod::ShapeKind>(next.byte() % names_of(fork.shape).size());
  fork.damping_law = static_cast<rod::DampingLaw>(next.byte() % 2);
  const unsigned dofs = next.byte();
  fork.dofs = {(dofs & 1U) == 0, (dofs & 2U) == 0, (dofs & 4U) == 0};
  const double factor = next.between_powers(-6.0, 12.0);
  fork.stiffness = {factor * fork.stiffness.stretch, factor * fork.stiffness.bend, factor * fork.stiffness.torsion};
  const double zeta = next.flag() ? next.between_powers(-4.0, 1.0) : 0.0;
  fork.damping_ratio = {zeta, zeta, zeta};
  settings.dynamics.integrator = static_cast<dynamics::IntegratorKind>(next.byte() % 6);
  settings.dynamics.error_bound = next.flag();
  settings.dynamics.tolerance = next.flag() ? next.between_powers(-9.0, -1.0) : 0.0;
  return settings;
}

/// The samples of a hand, and the largest step from each on [s].
struct Hand {
  std::vector<motion::PoseSample> samples;
  std::vector<double> steps;

  double interval(std::size_t k) const { return samples[k + 1].t - samples[k].t; }
  bool drops_out(std::size_t k) const { return interval(k) > simulation::SimulationSettings().dropout_after; }
  /// Whether it rests or trembles after sample k; its velocities come from the neighbours, too.
  bool keeps_still(std::size_t k) const {
    for (std::size_t i = k > 0 ? k - 1 : 0; i < std::min(k + 2, samples.size() - 1); ++i) {
      const RigidTransform &a = samples[i].X, &b = samples[i + 1].X;
      if (a.linear() != b.linear() || (a.translation() - b.translation()).norm() > kTremor * interval(i)) return false;
    }
    return true;
  }
};

Hand chosen_hand(Choices& next, double longest_step) {
  struct Move {
    double shift, turn, pause;  // m, rad, s
  };
  constexpr std::array<Move, 9> moves{{{0.0, 0.0, 0.0},    // rest
                                       {1e-9, 0.0, 0.0},   // trembling
                                       {1e-6, 0.0, 0.0},   // the same
                                       {1e-4, 0.0, 0.0},   // the same
                                       {1e-3, 0.0, 0.0},   // the same
                                       {0.02, 0.1, 0.0},   // sway
                                       {1.0, 0.0, 0.0},    // jump
                                       {0.0, kPi, 0.0},    // half a turn
                                       {0.3, 0.5, 0.6}}};  // dropout
  constexpr std::array<double, 4> steps_per_sample{1.0, 2.0, 5.0, 20.0};
  Hand hand;
  motion::PoseSample sample{0.0, make_transform(Vector3d::Zero(), Quaterniond(math::exp_so3({0.0, 1.0, 0.0})))};
  double step = std::min(next.between_powers(-6.0, -1.0), longest_step), interval = step;
  const auto add = [&](const Move& move) {
    hand.samples.push_back(sample);
    hand.steps.push_back(step);
    sample.t += move.pause > 0.0 ? move.pause : interval;
    const double angle = next.byte();
    const Vector3d direction = Vector3d(std::cos(angle), std::sin(angle), std::sin(3.0 * angle)).normalized();
    const double part = std::min(1.0, interval / kMoveTime);
    sample.X.translation() += part * move.shift * direction;
    if (move.turn > 0.0) sample.X.linear() = math::exp_so3(part * move.turn * direction) * sample.X.linear();
  };
  add(moves[5]);  // the object is carried once, so that what is kept from step to step has its size
  for (int i = 0; i < kMaxSamples && !next.over(); ++i) {
    const unsigned how = next.byte();
    if (how % 16 == 15) step = std::min(next.between_powers(-6.0, -1.0), longest_step);
    interval = std::min(kLongest, step * steps_per_sample[how / 64]);
    add(moves[how % 16 % moves.size()]);
  }
  for (int i = 0; i < kRests; ++i) add(moves[0]);
  return hand;
}

void check(const simulation::AdvanceReport& report, bool stable) {
  require(report.steps_rejected == 0 || !stable, "no step is refused");
  for (const std::optional<double>& bound : {report.local_error_bound, report.error_bound, report.angle_error_bound}) {
    require(!bound || (std::isfinite(*bound) && *bound >= 0.0), "an error bound is finite or none");
  }
  require(std::isfinite(report.position_error + report.angle_error + report.energy_error + report.energy_balance),
          "an estimate is finite");
}

/// The laws of the stability map: the energy grows by no more than the work of hand and gravity and the errors of
/// the steps (EnergyWatch::excess); their estimates have a limit for fixed steps of a method that conserves energy. It
/// is known what the work is while the hand rests or trembles. Explicit methods promise none of this, the relaxation of
/// `paper` is of another energy.
class Judge {
 public:
  Judge(const simulation::SimulationSettings& settings, double mass)
      : mass_(mass),
        length_(settings.fork.length),
        p_HO_(length_ * Vector3d::UnitZ() - settings.grasp.X_OE->translation()),
        kind_(dynamics::make_integrator(settings.dynamics.integrator)->energy()),
        limited_(settings.dynamics.tolerance == 0.0 && kind_ == Energy::conserved) {}

  bool stable() const { return kind_ != Energy::unbounded; }
  void restart() { watch_.reset(); }
  void look(const simulation::Simulation& simulation, double estimated, const motion::MotionSegment& handle) {
    if (mass_ == 0.0 || kind_ == Energy::not_applicable || !stable()) return;
    if (!watch_) watch_.emplace(mass_, length_);
    const tools::ToolState fork = simulation.tool();
    const bodies::BodyState& object = simulation.objects()[0];
    const Vector3d p = object.X_WO.translation();
    watch_->look({simulation.time(), fork.elastic_energy + fork.kinetic_energy, p, object.V_WO_W.linear,
                  p - fork.X_WH * p_HO_, estimated},
                 handle);
    require(watch_->excess() <= 1e-9, "no energy from nowhere: " + std::to_string(watch_->excess()));
    require(!limited_ || watch_->estimates() <= benchmark::EnergyWatch::max_share,
            "energy is conserved: " + std::to_string(watch_->estimates()));
  }

 private:
  using Energy = dynamics::Integrator::Energy;
  double mass_, length_;
  Vector3d p_HO_;  ///< centre of mass in the handle's frame for a rigid fork [m]
  Energy kind_;
  bool limited_;
  std::optional<benchmark::EnergyWatch> watch_;
};

}  // namespace

void steps(std::string_view bytes) {
  Choices next(bytes);
  simulation::SimulationSettings settings = chosen_settings(next);
  scene::Body object =
      box("object", {0.2, 0.1, 0.05}, next.flag() ? next.between_powers(-6.0, 6.0) : 0.0, Vector3d::Zero());
  object.movable = true;
  const bool to_tolerance = settings.dynamics.tolerance > 0.0;  // a span may then have a step each 2 µs
  const Hand hand = chosen_hand(next, to_tolerance ? 0.001 : kLongest);
  settings.dynamics.step = hand.steps[0];
  simulation::Simulation simulation(scene_of({object}, scene::ContactMode::none), settings);
  motion::PoseTrack track(settings.dropout_after);
  for (const motion::PoseSample& sample : hand.samples) {
    simulation.push_stylus(sample);
    track.push(sample);
  }
  Judge judge(settings, object.mass_properties.mass);
  int left = kMaxSteps;
  for (std::size_t k = 0; k + 1 < hand.samples.size() && left > 0; ++k) {
    const bool changes = hand.steps[k] != simulation.settings().dynamics.step;
    if (changes) simulation.change({}, simulation::DynamicsChange{{}, hand.steps[k], {}});
    const bool drops_out = hand.drops_out(k);
    const double from = hand.samples[k].t;
    if (drops_out) judge.restart();  // its speed ends suddenly
    const int spans = static_cast<int>(std::ceil(hand.interval(k) / hand.steps[k] * (1.0 - 1e-9)));
    for (int i = 1; i <= spans && left > 0; ++i) {
      const double t = i == spans ? hand.samples[k + 1].t : from + hand.interval(k) * i / spans;
      const motion::MotionSegment handle = track.segment(0.5 * (simulation.time() + t));
      const long before = test_support::allocations;
      const simulation::AdvanceReport report = simulation.advance_to(t);
      const long allocations = test_support::allocations - before;
      const bool first = i == 1 && (k < 3 || changes);
      require(first || allocations == 0, "a step takes nothing from the heap");
      left -= std::max(1, static_cast<int>(report.steps + report.substeps));
      check(report, judge.stable());
      check_finite(simulation);
      const bool arrives_elsewhere = drops_out && i == spans;
      if (arrives_elsewhere || !(drops_out || hand.keeps_still(k))) {
        judge.restart();
      } else {
        judge.look(simulation, report.energy_error, handle);
      }
    }
  }
}

}  // namespace spring_workbench::fuzz
