#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmark/method.h"
#include "benchmark/rod_case.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {

/// The scene of a rod case: its body alone, nothing to touch. A mass of 0 is a massless body.
scene::Scene rod_scene(const RodCase& one);

/// What one run gives.
struct RodRun {
  std::vector<RigidTransform> X_WO;  ///< at output_times(one)
  double wall_seconds = 0.0;
  long steps = 0;           ///< taken
  long steps_fallback = 0;  ///< of them by the rule that takes over where the integrator's equation is not solved
  bool finite = false;
  bool given_up = false;  ///< at the time limit
};

/// The same as what a method gives on a scene; nothing where it is not finite.
RunResult as_result(const Scenario& scene, const RodRun& run);

/// Settings under which Simulation runs the case: the body held from the first sample on, without contact.
simulation::SimulationSettings rod_settings(const RodCase& one, const std::string& shape, const std::string& integrator,
                                            double step, double tolerance = 0.0);

/// The pose of the handle with a number, in the order of their times, at rising times from 0 on without end.
using PoseSource = std::function<motion::PoseSample(std::size_t)>;

/// The samples of the case, which must outlive it; after the last one the hand is gone.
PoseSource poses_of_tracker(const RodCase& one);

/// The case through Simulation as its user runs it: two poses of the hand ahead, advance() to each output, the
/// object's pose there. The timed loop holds all of that, from the grasp on, and what `poses` takes. Steps of at most
/// `step` [s] that end at the poses, or as `tolerance` [m] chooses them; not finite where the object runs away or a
/// step is refused.
RodRun run_simulated(const RodCase& one, const std::string& shape, const std::string& integrator, double step,
                     double tolerance, const PoseSource& poses);
RodRun run_simulated(const RodCase& one, const std::string& shape, const std::string& integrator, double step,
                     double tolerance = 0.0);

}  // namespace spring_workbench::benchmark
