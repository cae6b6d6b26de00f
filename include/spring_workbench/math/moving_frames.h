#pragma once

#include "spring_workbench/math/spatial.h"

namespace spring_workbench::math {

inline Wrench sum(Wrench a, const Wrench& b) { return a += b; }
/// The twist of a frame that moves with the given one, its origin `p` [m] away, in the same axes.
inline Twist shifted(const Twist& V, const Vector3d& p) { return {V.linear + V.angular.cross(p), V.angular}; }
/// The wrench about a point from which the point of the given one is `p` [m] away, in the same axes.
inline Wrench shifted(const Wrench& F, const Vector3d& p) { return {F.force, F.moment + p.cross(F.force)}; }

/// The rotation by the smallest angle that turns `from` into the direction of `to`, both nonzero; by π about any
/// perpendicular axis, to half the digits, if they are opposite.
Matrix3d shortest_rotation(const Vector3d& from, const Vector3d& to);

/// Angular velocity of the frame that is `R` turned by the smallest angle so that its z axis is `n`, all in the axes
/// that `R` is in: `R` turns with `w` [rad/s], the unit vector `n` changes by `n_dot` [1/s]. It is `w` if `n` is −z of
/// `R`, where there is no smallest angle.
Vector3d aligned_rate(const Matrix3d& R, const Vector3d& w, const Vector3d& n, const Vector3d& n_dot);

}  // namespace spring_workbench::math
