#pragma once

#include "spring_workbench/math/spatial.h"

namespace spring_workbench::math {

inline Wrench sum(Wrench a, const Wrench& b) { return a += b; }
/// The twist of a frame that is fixed to the given one, its origin displaced by `p` [m], in the same axes.
inline Twist shifted(const Twist& V, const Vector3d& p) { return {V.linear + V.angular.cross(p), V.angular}; }
/// The wrench about another point; `p` [m] leads from there to the point of the given wrench, in the same axes.
inline Wrench shifted(const Wrench& F, const Vector3d& p) { return {F.force, F.moment + p.cross(F.force)}; }

/// The rotation by the smallest angle that turns `from`, not zero, into the direction of `to`, not zero. If they are
/// opposite, by π about a perpendicular axis, with half the digits.
Matrix3d shortest_rotation(const Vector3d& from, const Vector3d& to);

/// Angular velocity [rad/s] of the frame that results from turning `R` by the smallest angle so that its z axis is `n`.
/// `R` turns with `w` [rad/s], the unit vector `n` changes by `n_dot` [1/s], all in the axes that `R` is in. If `n` is
/// −z of `R`, there is no smallest angle, and the result is `w`.
Vector3d aligned_rate(const Matrix3d& R, const Vector3d& w, const Vector3d& n, const Vector3d& n_dot);

}  // namespace spring_workbench::math
