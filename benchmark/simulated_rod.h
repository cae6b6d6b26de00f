#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmark/method.h"
#include "benchmark/rod_case.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {

/// The scene of a rod case: only its body, nothing to touch. With mass 0 the body is massless.
scene::Scene rod_scene(const RodCase& one);

/// Result of one run.
struct RodRun {
  std::vector<RigidTransform> X_WO;  ///< at output_times(one)
  double wall_seconds = 0.0;
  long steps = 0;           ///< taken
  long steps_fallback = 0;  ///< steps taken by the fallback rule because the integrator's equation was not solved
  bool finite = false;
  bool given_up = false;  ///< whether the run exceeded the time limit

  void archive(math::StateArchive& state) { state(X_WO, wall_seconds, steps, steps_fallback, finite, given_up); }
};

/// Converts the run to the result of a method on a scene; empty outputs if it is not finite.
RunResult as_result(const Scenario& scene, const RodRun& run);

/// Settings of the case for Simulation: the body is held from the first sample on, without contact.
simulation::SimulationSettings rod_settings(const RodCase& one, const std::string& shape, const std::string& integrator,
                                            double step, double tolerance = 0.0);

/// Returns the pose of the handle with this number. Times increase from 0, without end.
using PoseSource = std::function<motion::PoseSample(std::size_t)>;

/// The samples of the case, which must outlive the result; after the last one the hand is lost.
PoseSource poses_of_tracker(const RodCase& one);

/// Runs the case through Simulation as an application would: pushes poses two ahead, calls advance() to each output,
/// and reads the object's pose there. The timed loop contains all of that, from the grasp on, including `poses`. Steps
/// are at most `step` [s] and end at the poses, or are chosen by `tolerance` [m]. The result is not finite if the
/// object escapes or a step is rejected.
RodRun run_simulated(const RodCase& one, const std::string& shape, const std::string& integrator, double step,
                     double tolerance, const PoseSource& poses);
RodRun run_simulated(const RodCase& one, const std::string& shape, const std::string& integrator, double step,
                     double tolerance = 0.0);

}  // namespace spring_workbench::benchmark
