#include "spring_workbench/dynamics/step_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/held_cases.h"

namespace spring_workbench {
namespace {

constexpr double sample_interval = 0.02;

/// A hand on sines of 1 to 2 Hz, as a tracker would see it.
std::vector<MotionSegment> sampled_hand(double duration, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vector3d rate, phase, width, turn;
  for (int i = 0; i < 3; ++i) {
    rate[i] = 2.0 * M_PI * (1.5 + 0.5 * uniform(random));
    phase[i] = M_PI * uniform(random);
    width[i] = 0.1 * uniform(random);
    turn[i] = 0.5 * uniform(random);
  }
  PoseTrack track;
  for (double t = 0.0; t < duration + 0.5 * sample_interval; t += sample_interval) {
    const Vector3d s = (rate * t + phase).array().sin();
    track.push({t, make_transform(Quaterniond(exp_so3(turn.cwiseProduct(s))), width.cwiseProduct(s))});
  }
  std::vector<MotionSegment> segments;
  for (double t = 0.0; t < duration - 0.5 * sample_interval; t += sample_interval) segments.push_back(track.segment(t));
  return segments;
}

class SteppedWithATolerance : public testing::TestWithParam<std::string> {};

TEST_P(SteppedWithATolerance, LandsWithinAFactorOfThreeOfItsTolerance) {
  const bool first_order = make_integrator(GetParam())->order() == 1;
  for (int trial = 0; trial < 8; ++trial) {
    std::mt19937 random(static_cast<unsigned>(trial));
    const double zeta = trial % 4 == 0 ? 0.1 : trial % 4 == 1 ? 0.5 : 1.0;
    Case c = random_case(shape_model_names()[static_cast<std::size_t>(trial) % shape_model_names().size()], zeta, 1.0, random);
    const std::vector<MotionSegment> hand = sampled_hand(0.5, random);
    const double tolerance = first_order ? 1e-3 : 1e-7;
    const StepControl control(make_integrator(GetParam()), tolerance);
    const auto reference = make_integrator("rk4");
    StepControl::Memory memory;
    StrainState state = c.held.zero_state(), exact = state;
    double largest = 0.0;
    std::size_t steps = 0;
    for (const MotionSegment& segment : hand) {
      const double t = segment.begin(), h = segment.end() - t;
      const ControlledStep step = control.advance(c.held, segment, t, h, state, memory);
      ASSERT_TRUE(step.fine);
      steps += static_cast<std::size_t>(step.steps);
      const int finer = 20 + static_cast<int>(c.omega * h * 20.0);
      for (int i = 0; i < finer; ++i) reference->step(c.held, segment, t + i * h / finer, h / finer, exact);
      c.hand = segment;
      largest = std::max(largest, distance(c, segment.end(), state, exact));
    }
    EXPECT_LT(largest, 3.0 * tolerance) << c.held.shape().name() << " " << trial;
    // From below where neither stability (explicit methods) nor a mode that decays within a step nor the samples, at which
    // a step ends, rule the step.
    const bool step_is_free = !limited_by_stiffness(GetParam()) && (first_order || zeta < 1.0) && steps > hand.size();
    EXPECT_TRUE(!step_is_free || largest > tolerance / 3.0) << c.held.shape().name() << " " << trial << " " << largest;
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, SteppedWithATolerance, testing::ValuesIn(integrator_names()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace spring_workbench
