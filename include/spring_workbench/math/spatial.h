#pragma once

#include <cmath>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench {

inline Vector6d to_vector(const Twist& V) { return (Vector6d() << V.linear, V.angular).finished(); }
inline Vector6d to_vector(const Wrench& F) { return (Vector6d() << F.force, F.moment).finished(); }
inline Twist to_twist(const Vector6d& v) { return {v.head<3>(), v.tail<3>()}; }
inline Wrench to_wrench(const Vector6d& f) { return {f.head<3>(), f.tail<3>()}; }

inline Wrench& operator+=(Wrench& a, const Wrench& b) { return a = {a.force + b.force, a.moment + b.moment}; }
inline Wrench operator-(const Wrench& a, const Wrench& b) { return {a.force - b.force, a.moment - b.moment}; }
inline bool is_zero(const Wrench& F) { return F.force.isZero(0.0) && F.moment.isZero(0.0); }

/// `mass` [kg] and `inertia` [kg·m²] of a rigid body about its centre, or their inverses, as one matrix.
template <typename Inertia>
Matrix6d spatial_matrix(double mass, const Eigen::MatrixBase<Inertia>& inertia) {
  Matrix6d M = Matrix6d::Zero();
  M.topLeftCorner<3, 3>().diagonal().setConstant(mass);
  M.bottomRightCorner<3, 3>() = inertia;
  return M;
}

/// Radius of gyration ρ [m] of a body of `mass` [kg] > 0, `inertia` [kg·m²] about its centre of mass: the root mean
/// square of those about its three principal axes, ρ² = tr I / (3 m).
inline double radius_of_gyration(double mass, const Matrix3d& inertia) {
  return std::sqrt(inertia.trace() / (3.0 * mass));
}

}  // namespace spring_workbench
