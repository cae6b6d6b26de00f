#pragma once

#include "spring_workbench/motion/motion_segment.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::bodies {

/// How a free body moves over a step, as its contacts were solved. Everything is at O, in world axes.
struct FreeMotion {
  std::size_t body = 0;     ///< index in the scene
  Twist start_W, change_W;  ///< velocity after the impacts at the start, and its change over the step
  Wrench load_W;            ///< of contact and gravity, constant
  Twist push_W;             ///< displacement that undoes penetrations
  bool is_pressed = false;  ///< whether a contact loads it
  bool mean = false;        ///< whether it moves with its mean velocity, or with that at the end
};

/// Estimate of the error of the path of any of its points over a step of `h` [s], as far as it is due to the length of
/// the step [m]. `radius`: of the body about O [m].
double path_error(const FreeMotion& motion, double radius, double h);

/// Returns the state after a step of `h` [s] from the pose `X_WO` under the constant load; see FreeBody.
motion::MotionState moved(const FreeMotion& motion, const scene::Body& body, const RigidTransform& X_WO, double h);

}  // namespace spring_workbench::bodies
