#include "benchmark/simulated_rod.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "benchmark/held_body.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {

scene::Scene rod_scene(const RodCase& one) {
  scene::Scene scene;
  scene.name = scene.path = one.name;
  scene.contact = scene::ContactMode::none;
  scene::Body body;
  body.name = "object";
  body.movable = true;
  if (one.mass > 0.0) {
    body.mass_properties.mass = one.mass;
    body.mass_properties.inertia_O = one.inertia.asDiagonal();
  }
  body.collision.push_back({geometry::Box{Vector3d(0.1, 0.1, 0.1)}});
  scene.bodies.push_back(body);
  return scene;
}

simulation::SimulationSettings rod_settings(const RodCase& one, const std::string& shape, const std::string& integrator,
                                            double step, double tolerance) {
  simulation::SimulationSettings settings;
  settings.contact = scene::ContactMode::none;
  settings.fork = one.fork;
  settings.fork.shape = validation::named<rod::ShapeKind>(shape, "benchmark", "shape");
  settings.dynamics.integrator = validation::named<dynamics::IntegratorKind>(integrator, "benchmark", "integrator");
  settings.dynamics.step = step;
  settings.dynamics.tolerance = tolerance;
  settings.grasp.object = "object";
  settings.grasp.start_follow = true;
  settings.grasp.X_OE = RigidTransform(Eigen::Translation3d(one.p_OE));
  return settings;
}

PoseSource poses_of_tracker(const RodCase& one) {
  return [&one](std::size_t i) {
    const bool there = i < one.hand.size();
    return there ? one.hand[i] : motion::PoseSample{std::numeric_limits<double>::infinity()};
  };
}

RodRun run_simulated(const RodCase& one, const std::string& shape, const std::string& integrator, double step,
                     double tolerance) {
  return run_simulated(one, shape, integrator, step, tolerance, poses_of_tracker(one));
}

RodRun run_simulated(const RodCase& one, const std::string& shape, const std::string& integrator, double step,
                     double tolerance, const PoseSource& poses) {
  using Clock = std::chrono::steady_clock;
  constexpr double same_time = 1e-9;   // s
  constexpr double farthest = 1000.0;  // m
  const std::vector<double> times = output_times(one);
  simulation::Simulation simulation(rod_scene(one), rod_settings(one, shape, integrator, step, tolerance));
  RodRun run;
  run.X_WO.reserve(times.size());
  std::size_t pushed = 0;
  double newest[2] = {0.0, 0.0};  // the times of the last poses but one, and but none [s]
  const Clock::time_point start = Clock::now();
  motion::PoseSample next = poses(0);
  for (const double t : times) {
    while (std::isfinite(next.t) && (pushed < 3 || newest[0] <= t + same_time)) {
      simulation.push_stylus(next);
      newest[0] = std::exchange(newest[1], next.t);
      next = poses(++pushed);
    }
    const simulation::AdvanceReport report = simulation.advance_to(t);
    run.steps += report.steps;
    run.steps_fallback += report.steps_fallback;
    run.X_WO.push_back(simulation.objects()[0].X_WO);
    const RigidTransform& X = run.X_WO.back();
    if (!X.matrix().allFinite() || X.translation().norm() > farthest || report.steps_rejected > 0) return run;
  }
  run.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  run.finite = true;
  return run;
}

RunResult as_result(const Scenario& scene, const RodRun& run) {
  RunResult result;
  result.finite = run.finite;
  if (!run.finite) return result;
  result.wall_seconds = run.wall_seconds;
  result.steps_fallback = run.steps_fallback;
  for (const RigidTransform& X : run.X_WO) result.outputs.push_back(scene_output(scene, X));
  return result;
}

}  // namespace spring_workbench::benchmark
