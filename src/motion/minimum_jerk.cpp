#include "spring_workbench/motion/minimum_jerk.h"

#include "spring_workbench/math/so3.h"

namespace spring_workbench::motion {

double minimum_jerk(double u) { return u * u * u * (10.0 + u * (-15.0 + 6.0 * u)); }

RigidTransform minimum_jerk_pose(const RigidTransform& a, const RigidTransform& b, double u) {
  return math::between(a, b, math::turn_between(a, b), minimum_jerk(u));
}

}  // namespace spring_workbench::motion
