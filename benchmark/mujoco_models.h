#pragma once

#include <string>

#include "benchmark/held_body.h"

namespace spring_workbench::benchmark {

/// Mass [kg], inertia [kg m²] or armature of the driven hand; the relative error of its acceleration is the ratio of
/// the object's inertia to this.
constexpr double kMujocoHandInertia = 1e12;

/// MJCF: a body on a free joint.
std::string mujoco_free_body_model(const FreeBody& body);

/// MJCF: the object alone, on a slide (A), a hinge (B) or a free joint (C).
std::string mujoco_object_model(const Scenario& scene);

/// MJCF: a hand on a slide, a hinge or a free joint, and on it the object by joints with the scene's springs.
std::string mujoco_joint_model(const Scenario& scene);

/// MJCF: a mocap hand and the object on a free joint, welded.
std::string mujoco_weld_model(const Scenario& scene);

}  // namespace spring_workbench::benchmark
