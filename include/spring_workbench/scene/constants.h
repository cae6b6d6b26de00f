#pragma once

// Each with its unit, the effect of a change, and the test that detects it (scripts/mutate).

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// Maximum mass of a body [kg]. Test: LoadScene.MassThatIsNotPositiveComesFromTheShapeOrIsRefused at 0.
constexpr double max_mass = 1e12;
/// Speed of approach below which a body does not bounce [m/s]. If larger, bounces end sooner; at 0 a body never comes
/// to rest. Test: none: no value tried makes one fail.
constexpr double rest_speed = 0.02;
/// Speed [m/s]; a body in contact is put to sleep when all its points have been slower than this for long enough. If
/// larger, creeping bodies stop. Test: RigidWorld.StackOfTenStandsAndSleeps at 0.
constexpr double asleep_speed = 2e-3;
/// cos 1°; normals within this angle belong to one face. If smaller, contacts of two faces are treated as those of one.
/// Test: Bench.AFineMeshGivesFewPointsThatKeepItsExtent.
constexpr double same_face = 0.9998;

}  // namespace spring_workbench::scene
