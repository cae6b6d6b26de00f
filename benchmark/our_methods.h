#pragma once

#include <vector>

#include "benchmark/method.h"

namespace spring_workbench::benchmark {

/// The integrators of this package, each of integrator_names(), on the `bushing`: once as `<name>` with the hand
/// sampled at every output (50 Hz), pose and velocity, as a tracker gives it, and once as `<name>_fine_hand` with a
/// sample at every step, though no more than 64 in an output interval. Between samples the hand is what MotionSegment
/// makes of it. The timed loop holds all of it: the hand's pose and velocity at each sample, the segment, the step, the
/// object's pose at the outputs.
std::vector<MethodPtr> our_methods();

}  // namespace spring_workbench::benchmark
