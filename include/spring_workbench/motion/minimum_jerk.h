#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::motion {

/// Goes from 0 to 1 while `u` does, at rest at both ends: `10 u³ − 15 u⁴ + 6 u⁵`, how people reach (Flash and Hogan,
/// J. Neuroscience 5(7), 1985).
double minimum_jerk(double u);

/// The pose at `u` (0 … 1) of a minimum-jerk motion from `a` to `b`: along the straight line and about the fixed axis.
RigidTransform minimum_jerk_pose(const RigidTransform& a, const RigidTransform& b, double u);

}  // namespace spring_workbench::motion
