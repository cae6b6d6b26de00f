#include "spring_workbench/stepping/step_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "support/held_cases.h"
#include "support/named.h"
#include "support/tracked_hand.h"

namespace spring_workbench::stepping::step_control_test {
namespace {

using namespace dynamics;

constexpr double sample_interval = 0.02;

/// A hand on sines of 1 to 2 Hz, as a tracker would see it.
std::vector<motion::MotionSegment> sampled_hand(double duration, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vector3d rate, phase, width, turn;
  for (int i = 0; i < 3; ++i) {
    rate[i] = 2.0 * M_PI * (1.5 + 0.5 * uniform(random));
    phase[i] = M_PI * uniform(random);
    width[i] = 0.1 * uniform(random);
    turn[i] = 0.5 * uniform(random);
  }
  motion::PoseTrack track;
  for (double t = 0.0; t < duration + 0.5 * sample_interval; t += sample_interval) {
    const Vector3d s = (rate * t + phase).array().sin();
    track.push({t, make_transform(width.cwiseProduct(s), Quaterniond(math::exp_so3(turn.cwiseProduct(s))))});
  }
  std::vector<motion::MotionSegment> segments;
  for (double t = 0.0; t < duration - 0.5 * sample_interval; t += sample_interval) segments.push_back(track.segment(t));
  return segments;
}

/// A rod on a hand, and where it is at the samples by the classical Runge–Kutta method at a fine step.
struct ReferenceRun {
  double zeta;
  Case rod;
  std::vector<motion::MotionSegment> hand;
  std::vector<StrainState> exact;
};

ReferenceRun make_run(int trial) {
  std::mt19937 random(static_cast<unsigned>(trial));
  const double zeta = trial % 4 == 0 ? 0.1 : trial % 4 == 1 ? 0.5 : 1.0;
  const std::string shape =
      test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()];
  ReferenceRun run{zeta, random_case(shape, zeta, 1.0, random), {}, {}};
  run.hand = sampled_hand(0.5, random);
  const auto reference = dynamics::make_integrator(dynamics::IntegratorKind::rk4);
  StrainState state = run.rod.held.zero_state();
  for (const motion::MotionSegment& segment : run.hand) {
    const double h = segment.end() - segment.begin();
    const int finer = 20 + static_cast<int>(run.rod.omega * h * 20.0);
    for (int i = 0; i < finer; ++i) {
      reference->step(run.rod.held, segment, segment.begin() + i * h / finer, h / finer, state);
    }
    run.exact.push_back(state);
  }
  return run;
}

/// Made once for all integrators.
const std::vector<ReferenceRun>& runs() {
  static const std::vector<ReferenceRun> made = [] {
    std::vector<ReferenceRun> all;
    for (int trial = 0; trial < 8; ++trial) all.push_back(make_run(trial));
    return all;
  }();
  return made;
}

class SteppedWithATolerance : public testing::TestWithParam<std::string> {};

TEST_P(SteppedWithATolerance, LandsWithinAFactorOfThreeOfItsTolerance) {
  const bool first_order = test_support::make_integrator(GetParam())->order() == 1;
  const double tolerance = first_order ? 1e-3 : 1e-7;
  if (!test_support::make_integrator(GetParam())->solves_the_equation_of_motion()) return;
  for (const ReferenceRun& run : runs()) {
    Case c = run.rod;
    const StepControl control(test_support::make_integrator(GetParam()), tolerance);
    StepControl::Memory memory;
    StrainState state = c.held.zero_state();
    double largest = 0.0;
    std::size_t steps = 0;
    for (std::size_t i = 0; i < run.hand.size(); ++i) {
      c.hand = run.hand[i];
      const double t = c.hand.begin(), h = c.hand.end() - t;
      const ControlledStep step = control.advance(c.held, c.hand, t, h, state, memory);
      ASSERT_TRUE(step.accepted);
      steps += static_cast<std::size_t>(step.steps);
      largest = std::max(largest, distance(c, c.hand.end(), state, run.exact[i]));
    }
    EXPECT_LT(largest, 3.0 * tolerance) << c.held.shape().size() << " coordinates, ζ " << run.zeta;
    // From below where neither stability (explicit methods) nor a mode that decays within a step nor the samples, at
    // which a step ends, rule the step.
    const bool step_is_free =
        !limited_by_stiffness(GetParam()) && (first_order || run.zeta < 1.0) && steps > run.hand.size();
    EXPECT_TRUE(!step_is_free || largest > tolerance / 3.0)
        << c.held.shape().size() << " coordinates, ζ " << run.zeta << " " << largest;
  }
}

/// Integrations of a run, those that were not accepted included, and its largest error at the samples.
struct Work {
  double integrations = 0.0, error = 0.0;
};

/// With a tolerance or, if that is 0, with `parts` steps from sample to sample.
Work work_on(const ReferenceRun& run, const std::string& integrator, double tolerance, int parts) {
  Case c = run.rod;
  const StepControl control(test_support::make_integrator(integrator), tolerance);
  StepControl::Memory memory;
  StrainState state = c.held.zero_state();
  Work work;
  for (std::size_t i = 0; i < run.hand.size(); ++i) {
    c.hand = run.hand[i];
    const double t = c.hand.begin(), h = (c.hand.end() - t) / parts;
    for (int part = 0; part < parts; ++part) {
      const ControlledStep step = control.advance(c.held, c.hand, t + part * h, h, state, memory);
      work.integrations += static_cast<double>(step.steps + step.substeps);
    }
    work.error = std::max(work.error, distance(c, c.hand.end(), state, run.exact[i]));
  }
  return work;
}

/// For the same error, with all attempts counted, a tolerance takes at most 1.5 times the integrations of fixed steps,
/// in the mean over tolerances.
TEST(StepControl, AToleranceTakesLittleMoreThanFixedStepsOfTheSameError) {
  for (const std::string integrator : {"exponential", "rosenbrock"}) {
    double sum = 0.0;
    int compared = 0;
    for (const ReferenceRun& run : runs()) {
      std::vector<Work> fixed;
      for (int parts = 1; parts <= 16; parts *= 2) fixed.push_back(work_on(run, integrator, 0.0, parts));
      for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8}) {
        const Work work = work_on(run, integrator, tolerance, 1);
        for (std::size_t i = 1; i < fixed.size(); ++i) {
          const Work &longer = fixed[i - 1], &shorter = fixed[i];
          if (!(longer.error > work.error && work.error >= shorter.error)) continue;
          const double share = std::log(longer.error / work.error) / std::log(longer.error / shorter.error);
          sum +=
              work.integrations / (longer.integrations * std::pow(shorter.integrations / longer.integrations, share));
          ++compared;
        }
      }
    }
    ASSERT_GT(compared, 5) << integrator;
    EXPECT_LT(sum / compared, 1.5) << integrator << ", " << compared << " runs";
  }
}

/// Notes the lengths of its steps [ns].
class NotesLengths final : public Integrator {
 public:
  NotesLengths(std::set<long>& lengths, int& steps) : lengths_(lengths), steps_(steps) {}
  int order() const override { return method_->order(); }
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return method_->energy(); }
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override {
    lengths_.insert(std::lround(1e9 * h));
    ++steps_;
    return method_->step(body, handle, t, h, state);
  }

 private:
  std::unique_ptr<Integrator> method_ = make_integrator(IntegratorKind::rosenbrock);
  std::set<long>& lengths_;
  int& steps_;
};

/// What a method computes for one length of its steps it can keep only if these are few.
TEST(StepControl, TheStepsToAToleranceAreOfFewLengths) {
  std::set<long> lengths;
  int steps = 0;
  for (const ReferenceRun& run : runs()) {
    Case c = run.rod;
    const StepControl control(std::make_unique<NotesLengths>(lengths, steps), 1e-8);
    StepControl::Memory memory;
    StrainState state = c.held.zero_state();
    for (const motion::MotionSegment& segment : run.hand) {
      c.hand = segment;
      ASSERT_TRUE(
          control.advance(c.held, c.hand, segment.begin(), segment.end() - segment.begin(), state, memory).accepted);
    }
  }
  EXPECT_GT(steps, 1000);
  EXPECT_LT(static_cast<double>(lengths.size()), 0.1 * steps);
}

/// A stiff fork at rest, bent by a load that its springs hold: the acceleration is the small difference of large ones,
/// and its rounding is no reason to halve the step.
TEST(StepControl, GoesOnInWholeStepsWhereALoadAndTheSpringsCancel) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 24; ++trial) {
    std::mt19937 random(static_cast<unsigned>(trial));
    Case c =
        random_case(test_support::shape_names()[static_cast<std::size_t>(trial) % test_support::shape_names().size()],
                    1.0, 1.0, random);
    const double stiffness = std::pow(10.0, 4.0 + trial % 8);
    rod::ForkSettings fork;
    fork.stiffness = {stiffness, stiffness, 0.01 * stiffness};
    fork.damping_ratio = {1.0, 1.0, 1.0};
    c.held.set_springs(fork);
    const Vector3d F = 0.005 * stiffness * Vector3d(uniform(random), uniform(random), uniform(random));
    c.held.set_load({F, Vector3d(0.05 * uniform(random), 0.05 * uniform(random), -0.02).cross(F)});
    const motion::MotionSegment hand(c.held.state_at(c.hand, 0.0).X_WH);
    for (const double h : {0.02, 0.002, 0.0003}) {
      const StepControl control(test_support::make_integrator("exponential"));
      StepControl::Memory memory;
      StrainState state = c.held.zero_state();
      for (int i = 0; i < 400; ++i) {
        const ControlledStep step = control.advance(c.held, hand, i * h, h, state, memory);
        ASSERT_TRUE(step.accepted);
        if (i * h < 0.1 && i < 200) continue;  // it swings in
        EXPECT_EQ(step.substeps, 0) << trial << " " << h << " " << i;
        EXPECT_EQ(step.fallback, 0) << trial << " " << h << " " << i;
      }
    }
  }
}

/// What the dampers of a tracked hand's fork take from it within a step is known along the path of the step, so no step
/// seems to gain energy for want of knowing it.
TEST(StepControl, TakesOneStepFromSampleToSampleOfATrackedHand) {
  int samples = 0, steps = 0;
  for (int trial = 0; trial < 24; ++trial) {
    std::mt19937 random(static_cast<unsigned>(trial));
    const std::vector<std::string> shapes = test_support::shape_names();
    Case c =
        random_case(shapes[static_cast<std::size_t>(trial) % shapes.size()], trial % 2 == 0 ? 1.0 : 0.3, 1.0, random);
    motion::PoseTrack track = test_support::tracked_hand(1.0, 1e-4, random);
    const StepControl control(test_support::make_integrator("exponential"));
    StepControl::Memory memory;
    StrainState state = c.held.zero_state();
    for (double t = 0.0; t < 0.99; t = c.hand.end()) {
      c.hand = track.segment(t);
      const ControlledStep step = control.advance(c.held, c.hand, t, c.hand.end() - t, state, memory);
      ASSERT_TRUE(step.accepted);
      ++samples;
      steps += step.steps;
    }
  }
  EXPECT_LT(steps, 1.02 * samples);
}

/// Solves its equation in the second half of the span of 1 s alone, by standing still.
class SolvesLater final : public Integrator {
 public:
  explicit SolvesLater(double from) : from_(from) {}
  int order() const override { return 1; }
  bool stiffly_stable() const override { return true; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory&, double t, double, StrainState& state) override {
    state.q_dot.setZero();
    return {body.zero_state().q, 0.0, body.zero_state().q, t >= from_};
  }

 private:
  double from_;
};

/// Where the integrator takes no step however short, those of the fallback become as long as they may, without a try of
/// each: after two parts of a length one of twice that length. Where it takes them again, it takes long ones.
TEST(StepControl, WhereNoShortStepWorksThoseOfTheFallbackGrow) {
  std::mt19937 random(1);
  const Case c = random_case("linear", 1.0, 1.0, random);
  const motion::MotionSegment rest(RigidTransform::Identity());
  const auto span = [&](double from) {
    const StepControl control(std::make_unique<SolvesLater>(from));
    StepControl::Memory memory;
    StrainState state = c.held.zero_state();
    return control.advance(c.held, rest, 0.0, 1.0, state, memory);
  };
  const ControlledStep never = span(2.0), later = span(0.5);
  EXPECT_EQ(never.fallback, 7);  // two 64th parts, then one each of a 32nd, 16th, 8th, 4th, half
  EXPECT_EQ(never.steps, 7);
  EXPECT_EQ(never.substeps, 6);
  EXPECT_EQ(later.fallback, 6);
  EXPECT_EQ(later.steps, 7);
}

/// A method of first order that should lose energy, and gains this share of it in a step of 1 s.
class GainsEnergy final : public Integrator {
 public:
  explicit GainsEnergy(double share) : share_(share) {}
  int order() const override { return 1; }
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::dissipated; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory&, double, double h, StrainState& state) override {
    state.q_dot *= std::sqrt(1.0 + share_ * h * h);
    return {body.zero_state().q, 0.0, body.zero_state().q, true};
  }

 private:
  double share_;
};

/// Eight times as many steps gain an eighth of it. Where even the 64th part of it is too much, no part is tried.
TEST(StepControl, HalvesNoStepForAnEnergyThatNoHalvingTakesFromIt) {
  std::mt19937 random(1);
  const Case c = random_case("linear", 1.0, 1.0, random);
  const motion::MotionSegment rest(RigidTransform::Identity());
  const auto span = [&](double share) {
    const StepControl control(std::make_unique<GainsEnergy>(share));
    StepControl::Memory memory;
    StrainState state{c.held.zero_state().q, 1e3 * c.held.units()};
    return control.advance(c.held, rest, 0.0, 1.0, state, memory);
  };
  const ControlledStep halved = span(1e-3), hopeless = span(1.0);
  EXPECT_EQ(halved.steps, 8);
  EXPECT_EQ(halved.fallback, 0);
  EXPECT_EQ(hopeless.steps, 1);
  EXPECT_EQ(hopeless.fallback, 1);
  EXPECT_EQ(hopeless.substeps, 0);
}

/// Steps that end beyond the rod's range, with a strain and with rates that come from nothing.
class LeavesTheRange final : public Integrator {
 public:
  int order() const override { return 1; }
  bool stiffly_stable() const override { return false; }  // so that no step is divided
  StepEstimate step(const HeldBody& body, const motion::Trajectory&, double, double, StrainState& state) override {
    const rod::StrainVector zero = body.zero_state().q;
    state.q = 5.0 * body.units();
    state.q[body.size() - 1] = -3.0 * body.units()[body.size() - 1];
    state.q_dot = 100.0 * body.units();
    return {zero, 0.0, zero, true};
  }
};

TEST(StepControl, AStopAddsNoEnergyWhateverTheStepHasGained) {
  std::mt19937 random(8);
  const motion::MotionSegment rest(RigidTransform::Identity());
  int stops = 0;
  for (const std::string& shape : test_support::shape_names()) {
    for (int trial = 0; trial < 20; ++trial) {
      const HeldBody held = random_case(shape, 0.0, 1.0, random).held;
      const auto energy = [&](const StrainState& s) {
        const motion::MotionState o = held.object(held.state_at(rest, 0.0), s);
        return held.elastic_energy(0.0, s) + held.kinetic_energy(o.velocity, o.X.linear()) +
               held.body().mass * held.gravity() * o.X.translation().z();
      };
      const StepControl control(std::make_unique<LeavesTheRange>());
      StepControl::Memory memory;
      StrainState state{0.1 * held.units(), 0.1 * held.units()};
      const double before = energy(state);
      const ControlledStep step = control.advance(held, rest, 0.0, 0.02, state, memory);
      stops += step.stops;
      EXPECT_TRUE(held.shape().admissible(held.full_state(0.02, state).q)) << shape;
      EXPECT_LT(energy(state), before + 1e-9 * std::abs(before)) << shape << " " << trial;
    }
  }
  EXPECT_GT(stops, 0);
}

/// A strain that is finite, but so far off that the equations overflow and have no modes.
TEST(StepControl, TakesNoStepFromAStrainFarOff) {
  std::mt19937 random(1);
  for (const std::string& integrator : test_support::integrator_names()) {
    for (const std::string& shape : test_support::shape_names()) {
      for (const bool stretch_alone : {false, true}) {
        Case c = random_case(shape, 1.0, 0.02, random);
        if (stretch_alone) c.held.set_dofs({true, false, false}, 0.0, 0.05, c.held.zero_state());
        for (const double size : {1e101, 1e153, 1e155, 1e200, 1e305}) {
          const StepControl control(test_support::make_integrator(integrator));
          StepControl::Memory memory;
          StrainState state = c.held.zero_state();
          state.q.setConstant(size);
          EXPECT_FALSE(control.advance(c.held, c.hand, 0.0, 0.02, state, memory).accepted)
              << integrator << " " << shape << " " << stretch_alone << " " << size;
          EXPECT_TRUE((state.q.array() == size).all() && state.q_dot.isZero(0.0));
        }
      }
    }
  }
}

/// The linear part there is not finite: no step is taken with one from before, and the next step has its own again.
TEST(StepControl, AStrainFarOffIsNotSolvedWithTheLinearPartOfAnother) {
  std::mt19937 random(1);
  for (const std::string& shape : test_support::shape_names()) {
    const Case c = random_case(shape, 1.0, 0.02, random);
    const std::unique_ptr<Integrator> integrator = make_integrator(IntegratorKind::exponential);
    const auto solves = [&](double size) {
      StrainState state = c.held.zero_state();
      state.q.setConstant(size);
      return integrator->step(c.held, c.hand, 0.0, 0.02, state).converged;
    };
    EXPECT_TRUE(solves(0.0)) << shape;
    EXPECT_FALSE(solves(1e200)) << shape;
    EXPECT_TRUE(solves(0.0)) << shape;
  }
}

/// What an explicit method that diverges takes for its error is of a strain that the rod cannot have.
TEST(StepControl, EveryNumberOfAReportIsFinite) {
  std::mt19937 random(1);
  for (const std::string& integrator : test_support::integrator_names()) {
    for (const std::string& shape : test_support::shape_names()) {
      for (const double tolerance : {0.0, 1e-3}) {
        Case c = random_case(shape, 1.0, 0.4, random);
        const double k = 1e4 * c.held.body().mass;
        rod::ForkSettings fork;
        fork.stiffness = {k, k, 0.01 * k};
        c.held.set_springs(fork);
        const StepControl control(test_support::make_integrator(integrator), tolerance, true);
        StepControl::Memory memory;
        StrainState state = c.held.zero_state();
        for (int i = 0; i < 20; ++i) {
          const ControlledStep step = control.advance(c.held, c.hand, 0.02 * i, 0.02, state, memory);
          EXPECT_TRUE(std::isfinite(step.position_error + step.angle_error + step.energy_error + step.energy_added))
              << integrator << " " << shape << " " << tolerance << " " << i << ": " << step.energy_error;
        }
      }
    }
  }
}

/// A hand that jerks and forks so stiff that rounding is more than the tolerance.
TEST_P(SteppedWithATolerance, EndsWhereNoStepKeepsIt) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  motion::PoseTrack track;
  for (int i = 0; i < 12; ++i) {
    const Vector3d by(normal(random), normal(random), normal(random));
    track.push({0.004 * i, make_transform(0.01 * by, Quaterniond(math::exp_so3(0.05 * by)))});
  }
  for (const double stiffness : {1e3, 1e9, 1e15}) {
    Case c = random_case(test_support::shape_names().front(), 1.0, 1.0, random);
    rod::ForkSettings fork;
    fork.stiffness = {stiffness, stiffness, stiffness};
    fork.damping_ratio = {1.0, 1.0, 1.0};
    c.held.set_springs(fork);
    const StepControl control(test_support::make_integrator(GetParam()), 1e-9);
    StepControl::Memory memory;
    StrainState state = c.held.zero_state();
    for (double t = 0.0; t < 0.04;) {
      const motion::MotionSegment segment = track.segment(t);
      for (const double h : {1e-4, segment.end() - t - 1e-4}) {
        const ControlledStep step = control.advance(c.held, segment, t, h, state, memory);
        const int most = static_cast<int>(h / 2e-6) + 1;
        EXPECT_LE(step.steps, most) << stiffness << " " << h;
        EXPECT_LE(step.substeps, 2 * most) << stiffness << " " << h;
        EXPECT_TRUE(step.accepted || stiffness > 1e3);
        EXPECT_TRUE(state.q.allFinite() && state.q_dot.allFinite()) << stiffness;
        t += h;
      }
    }
  }
}

/// A method whose steps are good but carry no deviation on: the two next to each other may be beyond all numbers.
class CarriesNothing final : public Integrator {
 public:
  int order() const override { return 4; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override {
    if (++steps_ > 1000) throw std::runtime_error("steps without end");
    return method_->step(body, handle, t, h, state);
  }
  void propagate_deviation(const HeldBody&, const motion::Trajectory&, double, double, const StrainState&,
                           const StrainState&, StrainState& deviation) override {
    deviation.q.setConstant(std::numeric_limits<double>::quiet_NaN());
  }

 private:
  std::unique_ptr<Integrator> method_ = make_integrator(IntegratorKind::rk4);
  int steps_ = 0;
};

TEST(StepControl, EndsWhereTheErrorOfTheRunCannotBeCarriedOn) {
  std::mt19937 random(3);
  const Case c = random_case("linear", 1.0, 0.02, random);
  const StepControl control(std::make_unique<CarriesNothing>(), 1e-6);
  StepControl::Memory memory;
  StrainState state = c.held.zero_state();
  ControlledStep step;
  ASSERT_NO_THROW(step = control.advance(c.held, c.hand, 0.0, 0.02, state, memory));
  EXPECT_TRUE(step.accepted);
  EXPECT_TRUE(state.q.allFinite());
}

INSTANTIATE_TEST_SUITE_P(Integrators, SteppedWithATolerance, testing::ValuesIn(test_support::integrator_names()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace spring_workbench::stepping::step_control_test
