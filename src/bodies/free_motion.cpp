#include "spring_workbench/bodies/free_motion.h"

#include <algorithm>

#include "spring_workbench/bodies/free_body.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::bodies {

double path_error(const FreeMotion& motion, double radius, double h) {
  const Twist& change = motion.change_W;
  if (!motion.mean) return 0.5 * h * (change.linear.norm() + radius * change.angular.norm());
  const Vector3d &start = motion.start_W.angular, end = start + change.angular;
  const double turn = h * std::max(start.norm(), end.norm());
  return motion.is_pressed ? 0.5 * turn * turn * radius : 0.0;
}

motion::MotionState moved(const FreeMotion& motion, const scene::Body& body, const RigidTransform& X_WO, double h) {
  FreeBody free(motion.body, body, 0.0, X_WO, motion.start_W);
  free.advance(h, motion.load_W);  // stays where it is if that is not finite
  motion::MotionState state = free.object();
  state.X.translation() += motion.push_W.linear;
  state.X.linear() = math::exp_so3(motion.push_W.angular) * state.X.linear();
  return state;
}

}  // namespace spring_workbench::bodies
