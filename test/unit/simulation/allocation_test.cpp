// A step makes no heap allocations, so that its time does not depend on other threads.
#include <gtest/gtest.h>

#include <cmath>

#include "spring_workbench/simulation/simulation.h"
#include "support/bench_scenes.h"
#include "support/count_allocations.h"

namespace spring_workbench::simulation::allocation_test {
namespace {

using test_support::allocations;

/// Allocations in 100 calls of advance with the default fork and a hand sampled at 50 Hz, after 100 warm-up calls.
long allocations_of(scene::ContactMode contact, const SimulationSettings& settings) {
  Simulation simulation(scene_of({box("box", {0.1, 0.06, 0.04}, 1.0, {0.0, 0.0, 0.5})}, contact, 0.5), settings);
  simulation.push_button(0.0, true);
  long during = 0;
  for (int i = 0; i < 202; ++i) {
    const double t = 0.02 * i;
    const Vector3d tip(0.1 * std::sin(4.0 * t), 0.05 * std::sin(6.0 * t), 0.7 + 0.05 * std::sin(5.0 * t));
    simulation.push_stylus({t, pointing_down(tip)});
    if (i < 2) continue;
    const long before = allocations;
    const AdvanceReport report = simulation.advance_to(t - 0.02);
    if (i < 102) continue;
    EXPECT_EQ(report.steps, 1);
    during += allocations - before;
  }
  EXPECT_TRUE(simulation.objects()[0].held);
  return during;
}

TEST(Allocation, AStepWithoutContactsTakesNothingFromTheHeapItself) {
  if (!COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer has its own heap";
  EXPECT_EQ(allocations_of(scene::ContactMode::none, {}), 0);
  EXPECT_LE(allocations_of(scene::ContactMode::stop, {}), 100);  // one a step by FCL, in its broad phase
  SimulationSettings settings;
  settings.dynamics.error_bound = true;
  EXPECT_EQ(allocations_of(scene::ContactMode::none, settings), 0);
}

}  // namespace
}  // namespace spring_workbench::simulation::allocation_test
