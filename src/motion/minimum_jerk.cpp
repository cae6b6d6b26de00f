#include "spring_workbench/motion/minimum_jerk.h"

#include "spring_workbench/math/so3.h"

namespace spring_workbench::motion {

double minimum_jerk(double u) { return u * u * u * (10.0 + u * (-15.0 + 6.0 * u)); }

RigidTransform minimum_jerk_pose(const RigidTransform& a, const RigidTransform& b, double u) {
  const double s = minimum_jerk(u);
  RigidTransform X = a;
  X.translation() += s * (b.translation() - a.translation());
  X.linear() = a.linear() * math::exp_so3(s * math::log_so3(a.linear().transpose() * b.linear()));
  return X;
}

}  // namespace spring_workbench::motion
