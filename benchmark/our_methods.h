#pragma once

#include <string>
#include <vector>

#include "benchmark/method.h"

namespace spring_workbench::benchmark {

/// The integrators of this package, each of integrator_names(), on the `bushing`, under their own names, twice: once
/// they know the hand as a function of time, as the peers do (hand() is "function": pose and velocity at the ends of
/// every step, though of no more than 64 in an output interval), and once by the poses of a 50 Hz tracker alone
/// ("samples": PoseTrack makes the velocities; the tracker runs since before the start and a sample ahead). The timed
/// loop holds all of it: the hand at the samples, the segments between them, the steps, the object's pose at the
/// outputs.
std::vector<MethodPtr> our_methods();

/// Of an integrator of this package by its name. Throws InputError if there is none.
bool solves_the_equation_of_motion(const std::string& integrator);

}  // namespace spring_workbench::benchmark
