#pragma once

#include <string>
#include <vector>

#include "benchmark/simulated_rod.h"

namespace spring_workbench::benchmark {

/// Names of the general methods that solve the library's own equation of motion, HeldBody::acceleration, for the strain
/// and its rate.
const std::vector<std::string>& solver_names();

/// Whether a method has a step size instead of a tolerance.
bool takes_step(const std::string& solver);

/// Runs a case with such a method and the step [s] or tolerance `setting`. On samples, steps end at each sample, as if
/// samples arrived one by one; only CVODE, which would have to restart there, continues and detects them by its error
/// estimate. If `function` is given, it is the hand, and the steps are free. The timed loop contains the steps and the
/// poses at the outputs. Not finite if the method fails.
RodRun run_solver(const RodCase& one, const std::string& shape, const std::string& solver, double setting,
                  const motion::FrameMotion* function = nullptr);

}  // namespace spring_workbench::benchmark
