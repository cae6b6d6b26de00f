#pragma once

#include <vector>

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

/// Exact outputs of scenes A and B on a sampled hand, at output_times(scene), which are those of its samples: between
/// two of them the hand moves along a cubic, so its acceleration and the steady part of the deflection are linear in
/// time, and the transient continues from the end of the previous segment.
std::vector<Vector3d> exact_outputs_on_samples(const Scenario& scene);

}  // namespace spring_workbench::benchmark
