#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/validation/names.h"
#include "support/bench_scenes.h"
#include "support/snapshots.h"

namespace spring_workbench::live::many_objects_test {
namespace {

constexpr double interval = 0.01;

/// A square of boxes on the bench, 0.1 m apart.
scene::Scene square(int side, scene::ContactMode mode) {
  std::vector<scene::Body> boxes;
  for (int i = 0; i < side * side; ++i) {
    const Vector3d p(0.1 * (i % side), 0.1 * (i / side), 0.02);
    boxes.push_back(box("box " + std::to_string(i), Vector3d(0.04, 0.04, 0.04), 0.1, p));
  }
  return scene_of(boxes, mode);
}

double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Least processor time [s] of a cycle, of the display and of both snapshots, while the first box is held and moved.
double cost_of(int side, scene::ContactMode mode) {
  SimulationRunner runner(square(side, mode), simulation::SimulationSettings(), hand_input::InputSettings(), false);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 200; ++k) {
    const double t = interval * k;
    HandEvents events;
    if (k == 0) events[0].emplace_back(NewEpoch{1'000'000'000});
    StylusPose pose;
    const Vector3d p(0.01 * std::sin(5.0 * t), 0.0, 0.22 + 0.1 * std::min(std::max(t - 0.5, 0.0), 1.0));
    pose.sample = {t, p, Quaterniond(pointing_down(p).linear())};
    pose.arrival = {t, t};
    events[0].emplace_back(pose);
    if (k == 20) events[0].emplace_back(StylusButton{t, motion::ButtonEdge::grasp});
    const double begin = processor_time();
    while (runner.cycle(events, {t, t}).more) events.clear();
    const auto shown = runner.show(0.02, {t, t}, always);
    const auto committed = runner.committed(always);
    if (k > 150) least = std::min(least, processor_time() - begin);
    EXPECT_EQ(shown->view.objects.size(), committed->view.objects.size());
  }
  EXPECT_TRUE(runner.locked([](const auto& s) { return s.objects()[0].held; }));
  return least;
}

/// Forty times as many objects at rest, and less than ten times the cost: nothing in a cycle looks at each of them by
/// name.
TEST(ManyObjects, AtRestTheyCostACycleLittle) {
  for (const scene::ContactMode mode :
       {scene::ContactMode::none, scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    const double few = cost_of(5, mode), many = cost_of(32, mode);
    std::cout << "contact " << validation::name_of(mode) << ": " << 1e6 * few << " us with 25 objects, " << 1e6 * many
              << " us with 1024\n";
    EXPECT_LT(many, 10.0 * few);
  }
}

}  // namespace
}  // namespace spring_workbench::live::many_objects_test
