#pragma once

#include <string>
#include <vector>

#include "benchmark/method.h"

namespace spring_workbench::benchmark {

/// The integrators of this package (integrator_names()) on the `bushing`, as runs of simulation::Simulation as used by
/// applications (run_simulated), in steps that end at the outputs. Simulation is given poses: those of the tracker or,
/// if the hand is a function of time, those of the function at the ends of the steps. Its interpolation between them is
/// then part of its error.
std::vector<MethodPtr> our_methods();

/// Whether the integrator of this name solves the equation of motion. Throws InputError if there is none.
bool solves_the_equation_of_motion(const std::string& integrator);

}  // namespace spring_workbench::benchmark
