// The bound of the run's error against a far finer run, over seeded hands, rods and damping.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "spring_workbench/stepping/step_control.h"
#include "support/held_cases.h"
#include "support/named.h"
#include "support/tracked_hand.h"

namespace spring_workbench::stepping::error_bound_test {
namespace {

using namespace dynamics;

constexpr double rounding = 1e-12;  // [m]; errors below it count as bounded

/// SPRING_WORKBENCH_BOUND_RUNS, or fewer every day.
int number_of_runs() {
  const char* asked = std::getenv("SPRING_WORKBENCH_BOUND_RUNS");
  return asked != nullptr ? std::atoi(asked) : 84;
}

/// Every damping ratio, shape, set of DOFs and noise of the hand in turn.
Case seeded_case(int run, std::mt19937& random) {
  const double zeta[] = {0.0, 0.01, 0.1, 0.5, 1.0, 3.0, 10.0};
  const std::vector<std::string> shapes = test_support::shape_names();
  Case c = random_case(shapes[static_cast<std::size_t>(run) % shapes.size()], zeta[run % 7], 1.0, random);
  const int dofs = 1 + run / 7 % 7;
  c.held.set_dofs({(dofs & 1) != 0, (dofs & 2) != 0, (dofs & 4) != 0}, 0.0, 0.05, c.held.zero_state());
  return c;
}

struct Distance {
  double position, angle;
};
Distance between(const HeldBody& held, const HandleState& at, const StrainState& a, const StrainState& b) {
  const RigidTransform A = held.object(at, a).X, B = held.object(at, b).X;
  return {(A.translation() - B.translation()).norm(), math::turn_between(A, B).norm()};
}

struct Found {
  int steps = 0, unbounded = 0, below = 0, locally_below = 0, runs = 0, runs_unbounded = 0;
  int estimated = 0, well_estimated = 0;  ///< steps; those with an estimate within a factor of ten
  std::vector<double> over, locally_over;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Steps of 1/50 s, one for each sample, against sixteen of `exponential` for each; the local errors from the same
/// begin.
void run_one(int run, double duration, const std::string& integrator, Found& found) {
  std::mt19937 random(static_cast<unsigned>(1000 + run));
  Case c = seeded_case(run, random);
  const double noise[] = {0.0, 1e-4, 1e-3};
  motion::PoseTrack track = test_support::tracked_hand(duration, noise[run % 3], random);
  const StepControl control(test_support::make_integrator(integrator), 0.0, true);
  const auto exact = dynamics::make_integrator(IntegratorKind::exponential),
             exact_step = dynamics::make_integrator(IntegratorKind::exponential);
  StepControl::Memory memory;
  StrainState state = c.held.zero_state(), truth = state;
  bool unbounded = false;
  for (double t = 0.0; t < duration - 0.01;) {
    const motion::MotionSegment hand = track.segment(t);
    const double h = hand.end() - t;
    StrainState local = state;
    for (int i = 0; i < 16; ++i) {
      exact->step(c.held, hand, t + i * h / 16, h / 16, truth);
      exact_step->step(c.held, hand, t + i * h / 16, h / 16, local);
    }
    const ControlledStep step = control.advance(c.held, hand, t, h, state, memory);
    ASSERT_TRUE(step.accepted);
    t = hand.end();
    ++found.steps;
    ASSERT_TRUE(std::isfinite(memory.error_bound) && std::isfinite(memory.angle_bound)) << run;
    if (!memory.bounded) {
      ++found.unbounded;
      unbounded = true;
      truth = state;
      continue;
    }
    const HandleState end = c.held.state_at(hand, t);
    const Distance of_run = between(c.held, end, state, truth), of_step = between(c.held, end, state, local);
    if (of_run.position > rounding) {
      found.over.push_back(memory.error_bound / of_run.position);
      if (memory.error_bound < of_run.position) ++found.below;
    }
    if (of_run.angle > 10.0 * rounding && memory.angle_bound < of_run.angle) ++found.below;
    if (of_step.position > rounding) {
      const double ratio = step.position_error / of_step.position;
      ++found.estimated;
      if (ratio > 0.1 && ratio < 10.0) ++found.well_estimated;
    }
    if (of_step.position > rounding && step.bounds.local) {
      found.locally_over.push_back(*step.bounds.local / of_step.position);
      if (*step.bounds.local < of_step.position) ++found.locally_below;
    }
  }
  ++found.runs;
  if (unbounded) ++found.runs_unbounded;
}

Found runs(int count, double duration, const std::string& integrator) {
  Found found;
  for (int run = 0; run < count; ++run) run_one(run, duration, integrator, found);
  return found;
}

TEST(ErrorBound, IsNotBelowTheErrorOfRunsAndSteps) {
  const Found found = runs(number_of_runs(), 2.0, "exponential");
  EXPECT_EQ(found.below, 0) << "of " << found.over.size();
  EXPECT_EQ(found.locally_below, 0) << "of " << found.locally_over.size();
  EXPECT_LE(found.unbounded, 0.05 * found.steps);
  EXPECT_LE(found.runs_unbounded, 0.05 * found.runs);
  EXPECT_LT(median(found.over), 30.0);
  EXPECT_LT(median(found.locally_over), 30.0);
  EXPECT_GT(found.well_estimated, 0.9 * found.estimated);
  std::printf(
      "%d runs, %d steps: %d and %d below; %d steps and %d runs without; medians %.3g and %.3g, least %.3g and "
      "%.3g; %d of %d estimates within a factor of ten\n",
      found.runs, found.steps, found.below, found.locally_below, found.unbounded, found.runs_unbounded,
      median(found.over), median(found.locally_over), *std::min_element(found.over.begin(), found.over.end()),
      *std::min_element(found.locally_over.begin(), found.locally_over.end()), found.well_estimated, found.estimated);
}

class BoundOf : public testing::TestWithParam<std::string> {};

TEST_P(BoundOf, IsNotBelowTheErrorOfRuns) {
  const Found found = runs(std::min(28, number_of_runs()), 1.0, GetParam());
  EXPECT_EQ(found.below, 0) << "of " << found.over.size();
  EXPECT_LE(found.unbounded, 0.05 * found.steps);
  EXPECT_LT(median(found.over), 30.0);
}

INSTANTIATE_TEST_SUITE_P(Integrators, BoundOf, testing::ValuesIn(test_support::integrator_names()),
                         [](const auto& instance) { return instance.param; });

/// What is followed is not what is integrated.
TEST_P(BoundOf, ChangesNoBitOfTheMotionAndIsNoneWhereItIsOff) {
  for (int run = 0; run < 21; ++run) {
    std::mt19937 random(static_cast<unsigned>(run));
    Case c = seeded_case(run, random);
    motion::PoseTrack track = test_support::tracked_hand(0.3, 1e-3, random);
    const double tolerance = run % 7 == 4 ? 1e-3 : 0.0;
    const StepControl with(test_support::make_integrator(GetParam()), tolerance, true),
        without(test_support::make_integrator(GetParam()), tolerance, false);
    StepControl::Memory memory, memory_without;
    StrainState state = c.held.zero_state(), state_without = state;
    for (double t = 0.0; t < 0.29;) {
      const motion::MotionSegment hand = track.segment(t);
      with.advance(c.held, hand, t, hand.end() - t, state, memory);
      const ControlledStep step = without.advance(c.held, hand, t, hand.end() - t, state_without, memory_without);
      t = hand.end();
      ASSERT_TRUE(state.q == state_without.q && state.q_dot == state_without.q_dot) << run << ": " << t;
      ASSERT_EQ(step.bounds.unbounded, step.steps);
      ASSERT_FALSE(memory_without.bounded);
    }
  }
}

TEST(ErrorBound, IsNoneInContactAndBeginsAnewAfterItAndAfterAChangeFromOutside) {
  for (const bool by_contact : {true, false}) {
    std::mt19937 random(3);
    Case c = seeded_case(48, random);
    motion::PoseTrack track = test_support::tracked_hand(0.2, 0.0, random);
    const StepControl control(test_support::make_integrator("exponential"), 0.0, true);
    StepControl::Memory memory;
    StrainState state = c.held.zero_state();
    bool begins = true;
    for (int step = 0; step < 9; ++step) {
      const motion::MotionSegment hand = track.segment(0.02 * step);
      const bool touches = by_contact && (step == 4 || step == 5);
      c.held.set_load({Vector3d(0, 0, touches ? 1.0 : 0.0), Vector3d::Zero()});
      const bool changed = !by_contact && step == 6;
      if (changed) state.q_dot *= 0.5;
      const double t = step == 0 ? 0.0 : memory.t;
      const ControlledStep done = control.advance(c.held, hand, t, hand.end() - t, state, memory);
      EXPECT_EQ(done.bounds.unbounded, memory.bounded ? 0 : done.steps) << step;
      if (touches) {
        EXPECT_FALSE(memory.bounded) << step;
      }
      if (step < 4 || step > 6) {  // where it begins anew, the rate of convergence may not be known
        EXPECT_TRUE(memory.bounded) << step;
      }
      begins |= changed || !memory.bounded;
      if (begins && memory.bounded) {
        EXPECT_LE(memory.error_bound, done.bounds.local.value()) << step;
        begins = false;
      }
    }
  }
}

}  // namespace
}  // namespace spring_workbench::stepping::error_bound_test
