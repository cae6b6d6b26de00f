#pragma once

#include <string>
#include <vector>

#include "benchmark/method.h"

namespace spring_workbench::benchmark {

/// The integrators of this package, each of integrator_names(), on the `bushing`, under their own names, in steps that
/// end at the outputs. On a sampled hand: simulation::Simulation as its user runs it (run_simulated). On a hand that is
/// a function of time, which Simulation does not take: the library's integrator on a dynamics::HeldBody and a
/// motion::FrameMotion, which is asked for pose, velocity and acceleration at the moments that the rule needs, four at
/// once; the timed loop holds the hand, the steps and the object's pose at the outputs.
std::vector<MethodPtr> our_methods();

/// Of an integrator of this package by its name. Throws InputError if there is none.
bool solves_the_equation_of_motion(const std::string& integrator);

}  // namespace spring_workbench::benchmark
