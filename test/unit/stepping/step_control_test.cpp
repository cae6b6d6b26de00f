#include "spring_workbench/stepping/step_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
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
    track.push({t, make_transform(Quaterniond(math::exp_so3(turn.cwiseProduct(s))), width.cwiseProduct(s))});
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
    c.held.set_external_wrench({F, Vector3d(0.05 * uniform(random), 0.05 * uniform(random), -0.02).cross(F)});
    const motion::MotionSegment hand(c.held.forcing(c.hand, 0.0).X_WH);
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

/// A hand that jerks and forks so stiff that rounding is more than the tolerance.
TEST_P(SteppedWithATolerance, EndsWhereNoStepKeepsIt) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  motion::PoseTrack track;
  for (int i = 0; i < 12; ++i) {
    const Vector3d by(normal(random), normal(random), normal(random));
    track.push({0.004 * i, make_transform(Quaterniond(math::exp_so3(0.05 * by)), 0.01 * by)});
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

INSTANTIATE_TEST_SUITE_P(Integrators, SteppedWithATolerance, testing::ValuesIn(test_support::integrator_names()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace spring_workbench::stepping::step_control_test
