#pragma once

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench {

using Vector6d = Eigen::Matrix<double, 6, 1>;  ///< [linear; angular] or [force; moment]
using Matrix6d = Eigen::Matrix<double, 6, 6>;

inline Vector6d to_vector(const Twist& V) { return (Vector6d() << V.linear, V.angular).finished(); }
inline Vector6d to_vector(const Wrench& F) { return (Vector6d() << F.force, F.moment).finished(); }
inline Twist to_twist(const Vector6d& v) { return {v.head<3>(), v.tail<3>()}; }
inline Wrench to_wrench(const Vector6d& f) { return {f.head<3>(), f.tail<3>()}; }

}  // namespace spring_workbench
