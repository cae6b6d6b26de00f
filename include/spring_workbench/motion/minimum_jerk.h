#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::motion {

/// Minimum-jerk profile of human reaching, from 0 to 1 for u = 0 … 1, at rest at both ends: `10 u³ − 15 u⁴ + 6 u⁵`
/// (Flash and Hogan, J. Neuroscience 5(7), 1985).
double minimum_jerk(double u);

/// The pose at `u` (0 … 1) of a minimum-jerk motion from `a` to `b` along a straight line and about a fixed axis.
RigidTransform minimum_jerk_pose(const RigidTransform& a, const RigidTransform& b, double u);

}  // namespace spring_workbench::motion
