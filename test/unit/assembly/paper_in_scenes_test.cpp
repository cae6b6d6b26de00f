// The integrator `paper` in every shipped scene, with every set of degrees of freedom, hand and step from 1 to 50 ms:
// no step is rejected, as the paper's scheme is a relaxation to a target.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "spring_workbench/assembly/trial.h"
#include "spring_workbench/math/so3.h"
#include "support/bench_scenes.h"
#include "support/paths.h"

namespace spring_workbench::assembly::paper_in_scenes_test {
namespace {

/// Number of cases to run: SPRING_WORKBENCH_PAPER_RUNS, or fewer by default.
std::size_t number_of_runs() {
  const char* asked = std::getenv("SPRING_WORKBENCH_PAPER_RUNS");
  return asked != nullptr ? static_cast<std::size_t>(std::atol(asked)) : 60;
}

enum class Hand { carries, trembles, jumps, swings, assembles };
constexpr double duration = 3.0;  ///< of the hands but the last one [s]

struct Case {
  std::size_t scene = 0;
  int dofs = 7;  ///< by bits: stretch, bend, torsion
  Hand hand = Hand::carries;
  double step = 0.02;  ///< [s]
};

struct Counts {
  int steps = 0, rejected = 0, fallback = 0;
};

std::vector<scene::Scene> shipped_scenes() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(test_support::checkout("scenes"))) {
    if (entry.path().extension() == ".urdf") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  std::vector<scene::Scene> scenes;
  for (const std::string& file : files) scenes.push_back(scene::load_scene(file));
  return scenes;
}

/// Every case, in a seeded order.
std::vector<Case> cases(const std::vector<scene::Scene>& scenes) {
  std::vector<Case> all;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    for (int dofs = 1; dofs < 8; ++dofs) {
      for (const Hand hand : {Hand::carries, Hand::trembles, Hand::jumps, Hand::swings, Hand::assembles}) {
        if (hand == Hand::assembles && scenes[scene].targets.empty()) continue;
        for (const double step : {0.001, 0.002, 0.005, 0.01, 0.02, 0.05}) all.push_back({scene, dofs, hand, step});
      }
    }
  }
  std::shuffle(all.begin(), all.end(), std::mt19937(23));
  return all;
}

simulation::SimulationSettings settings_of(const Case& c) {
  simulation::SimulationSettings settings;
  settings.grasp.calibrate = tools::Calibration::world;
  settings.dynamics.integrator = dynamics::IntegratorKind::paper;
  settings.dynamics.step = c.step;
  settings.fork.dofs = {(c.dofs & 1) != 0, (c.dofs & 2) != 0, (c.dofs & 4) != 0};
  return settings;
}

/// Pose of the hand, starting at `start`: carries the object away, tilts, and presses it onto the bench; holds it up
/// and trembles; jumps up by 0.3 m and back; or moves and turns along sines.
RigidTransform pose(Hand hand, double t, const Vector3d& start, std::mt19937& random) {
  const auto wobble = [&](double size) {
    std::normal_distribution<double> normal(0.0, size);
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vector3d(x, y, z);
  };
  const auto rise = [](double u) { return 0.5 * (1.0 - std::cos(M_PI * std::clamp(u, 0.0, 1.0))); };
  Vector3d way = Vector3d::Zero(), turn = Vector3d::Zero();
  switch (hand) {
    case Hand::carries:
      way = Vector3d(0.0, 0.2 * rise(t - 0.5), 0.3 * rise(t) - 0.35 * rise(t - 1.5));
      turn = Vector3d(0.6 * (rise(t) - rise(t - 1.5)), 0.0, 0.5 * rise(t));
      break;
    case Hand::trembles:
      way = Vector3d(0.0, 0.0, 0.2 * rise(t)) + wobble(1e-3);
      turn = wobble(5e-3);
      break;
    case Hand::jumps:
      way.z() = t > 1.0 && t < 2.0 ? 0.3 : 0.0;
      break;
    case Hand::swings:
      way = Vector3d(0.15 * std::sin(6.3 * t), 0.15 * std::sin(8.2 * t), 0.3 * rise(t) + 0.1 * std::sin(10.7 * t));
      turn = Vector3d(0.6 * std::sin(5.0 * t), 0.6 * std::sin(7.0 * t), 0.0);
      break;
    case Hand::assembles:
      break;
  }
  RigidTransform X = pointing_down(start + way);
  X.linear() = math::exp_so3(turn) * X.linear();
  return X;
}

/// Runs with the tip next to the centre of one of the objects.
Counts run_open(const scene::Scene& scene, const Case& c, std::mt19937& random) {
  std::vector<const scene::Body*> movable;
  for (const scene::Body& body : scene.bodies) {
    if (body.movable) movable.push_back(&body);
  }
  const scene::Body& body = *movable[random() % movable.size()];
  simulation::SimulationSettings settings = settings_of(c);
  settings.grasp.object = body.name;
  simulation::Simulation simulation(scene, settings);
  const Vector3d start = body.X_WO.translation() + Vector3d(0.01, 0.005, settings.fork.length);
  const double interval = std::max(0.02, c.step);
  for (int k = 0; k * interval < duration + 0.1; ++k) {
    simulation.push_stylus({k * interval, pose(c.hand, k * interval, start, random)});
  }
  const simulation::AdvanceReport report = simulation.advance_to(duration);
  EXPECT_TRUE(object(simulation, body.name).X_WO.matrix().allFinite());
  EXPECT_LT(object(simulation, body.name).X_WO.translation().norm(), 10.0);
  EXPECT_EQ(simulation.tool().held_object, body.name);
  return {static_cast<int>(report.steps), report.steps_rejected, report.steps_fallback};
}

/// Runs the whole task of the scene.
Counts run_task(const scene::Scene& scene, const Case& c) {
  OperatorSettings hand;
  hand.rate = 1.0 / std::max(0.02, c.step);
  const Trial trial = run_trial(scene, settings_of(c), hand);
  return {static_cast<int>(trial.motion.size()), trial.steps_rejected, 0};
}

TEST(PaperInScenes, NoStepIsRejectedInAnyShippedScene) {
  const std::vector<scene::Scene> scenes = shipped_scenes();
  ASSERT_GE(scenes.size(), 8u);
  std::vector<Case> all = cases(scenes);
  all.resize(std::min(all.size(), number_of_runs()));
  std::mt19937 random(5);
  Counts sum;
  for (const Case& c : all) {
    const scene::Scene& scene = scenes[c.scene];
    const Counts counts = c.hand == Hand::assembles ? run_task(scene, c) : run_open(scene, c, random);
    EXPECT_EQ(counts.rejected + counts.fallback, 0)
        << scene.name << " DOFs " << c.dofs << " hand " << static_cast<int>(c.hand) << " step " << c.step;
    sum.steps += counts.steps;
    sum.rejected += counts.rejected;
  }
  RecordProperty("runs", static_cast<int>(all.size()));
  RecordProperty("steps", sum.steps);
  RecordProperty("rejected", sum.rejected);
}

}  // namespace
}  // namespace spring_workbench::assembly::paper_in_scenes_test
