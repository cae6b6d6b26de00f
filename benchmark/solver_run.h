#pragma once

#include <string>
#include <vector>

#include "benchmark/simulated_rod.h"

namespace spring_workbench::benchmark {

/// Names of the general methods that solve the library's own equation of motion, HeldBody::acceleration, for the strain
/// and its rate.
const std::vector<std::string>& solver_names();

/// Whether a general method on samples runs through them instead of stopping at each.
bool runs_through(const std::string& solver);

/// Whether a method has a step size instead of a tolerance.
bool takes_step(const std::string& solver);

/// Whether a method differs from another one only in that it stops at each sample, or does not.
bool is_for_samples(const std::string& solver);

/// Whether a method on samples that are rarer than the outputs is better off with steps from sample to sample and
/// dense output: the implicit ones with a good one. The others need shorter steps there, or their dense output is worse
/// than their steps.
bool gains_from_long_steps(const std::string& solver);

/// Where the steps of a run on samples have to end. The outputs between them come from the method's dense output.
enum class StepEnds { samples, samples_and_outputs };

/// Runs a case with such a method and the step [s] or tolerance `setting`. On samples, steps end at each sample, where
/// the hand's acceleration jumps; CVODE, unless it is restarted, and methods `_through` continue and find the jumps by
/// their error estimate. If `function` is given, it is the hand, and the steps are free. The timed loop contains the
/// steps and the poses at the outputs. Not finite if the method fails.
RodRun run_solver(const RodCase& one, const std::string& shape, const std::string& solver, double setting,
                  StepEnds step_ends_at, const motion::Trajectory* function = nullptr);

}  // namespace spring_workbench::benchmark
