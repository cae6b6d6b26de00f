#pragma once

#include <string>
#include <vector>

#include "benchmark/simulated_rod.h"

namespace spring_workbench::benchmark {

/// The general methods that are given the library's own equation of motion, HeldBody::acceleration, in the strain and
/// its rate.
const std::vector<std::string>& solver_names();

/// Whether a method takes a step rather than a tolerance.
bool takes_step(const std::string& solver);

/// A case by such a method, with the step [s] or the tolerance `setting`. On samples: steps end at each of them, as
/// where they come one by one, but CVODE's, which would have to begin anew there: it goes on and finds them by its
/// error. Where `function` is given, it is the hand: steps end where they like. The timed loop holds the steps and the
/// poses at the outputs. Not finite where the method gives up.
RodRun run_solver(const RodCase& one, const std::string& shape, const std::string& solver, double setting,
                  const motion::FrameMotion* function = nullptr);

}  // namespace spring_workbench::benchmark
