#pragma once

#include "benchmark/scenarios.h"

namespace spring_workbench::benchmark {

/// Exact deflection of scenes A and B: extension [m] or twist [rad] of the spring, with its first two derivatives.
///
/// With x the deflection, M its mass or inertia and the hand u = a sin Ωt:  M ẍ + c ẋ + k x = −M g − M ü,
/// x(0) = ẋ(0) = 0 (no g in B). Static part, steady oscillation by its complex amplitude, and the transient of the
/// damped oscillator at any ζ ≥ 0.
ScalarMotion exact_deflection(const Scenario& scene, double t);

/// Exact output of scenes A and B: (0, 0, height) [m] or (0, 0, twist) [rad] of the object in world.
Vector3d exact_output(const Scenario& scene, double t);

}  // namespace spring_workbench::benchmark
