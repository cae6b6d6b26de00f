#pragma once

#include <string>
#include <vector>

#include "benchmark/method.h"

namespace spring_workbench::benchmark {

/// The integrators of this package, each of integrator_names(), on the `bushing`, under their own names: runs of
/// simulation::Simulation as its user drives it (run_simulated), in steps that end at the outputs. Simulation takes
/// poses: those of the tracker, or, where the hand is a function of time, the function's at the ends of the steps. What
/// it makes of the motion between them is then part of its error.
std::vector<MethodPtr> our_methods();

/// Of an integrator of this package by its name. Throws InputError if there is none.
bool solves_the_equation_of_motion(const std::string& integrator);

}  // namespace spring_workbench::benchmark
