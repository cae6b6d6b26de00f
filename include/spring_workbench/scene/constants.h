#pragma once

// Each with its unit, what changing it does, and the test that notices (scripts/mutate).

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// [m/s]; an approach that is slower does not bounce. Larger: bounces end sooner; at 0 a body never comes to rest.
/// Test: none: no value tried makes one fail.
constexpr double rest_speed = 0.02;
/// [m/s] of every point of a body in contact; slower for long enough, it goes to sleep. Larger: what creeps stops.
/// Test: RigidWorld.StackOfTenStandsAndSleeps at 0.
constexpr double asleep_speed = 2e-3;
/// Cos 1°; normals nearer to each other are of one face. Smaller: contacts of two faces are taken for one face's. Test:
/// Bench.AFineMeshGivesFewPointsThatKeepItsExtent.
constexpr double same_face = 0.9998;

}  // namespace spring_workbench::scene
