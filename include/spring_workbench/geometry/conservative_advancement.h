#pragma once

#include "spring_workbench/geometry/box_gap.h"

namespace spring_workbench::geometry {

/// A body's motion for f = 0 … 1: its origin moves along the line p + f · move, and it rotates about a fixed axis at a
/// constant rate.
struct StraightMotion {
  Vector3d p_WO = Vector3d::Zero();    ///< position of the body's origin at f = 0 [m]
  Vector3d move_W = Vector3d::Zero();  ///< [m]
  Vector3d turn_W = Vector3d::Zero();  ///< [rad]

  /// How far from its origin the body can touch what is within `radius` of a point [m].
  double reach(const Vector3d& p_W, double radius) const { return (p_W - p_WO).norm() + move_W.norm() + radius; }
  /// How far the body's points can go that are no further from its origin than `most_O` along its own axes: in any
  /// direction, and along one [m].
  double max_displacement(const Matrix3d& R_OW, const Vector3d& most_O) const;
  double max_displacement_along(const Vector3d& n_W, const Matrix3d& R_OW, const Vector3d& most_O) const {
    return n_W.dot(move_W) + (R_OW * n_W.cross(turn_W)).cwiseAbs().dot(most_O);
  }
};
StraightMotion straight_motion(const RigidTransform& X0_WO, const RigidTransform& X1_WO);

/// The half-space n·x < height.
struct HalfSpace {
  Vector3d n_W = Vector3d::UnitZ();  ///< unit
  double height = 0.0;               ///< [m]
};

/// Fraction of `motion`, at most `limit`, up to which it is guaranteed that no corner of the body's box is deeper
/// than `tolerance` [m] in the half-space: a corner's height differs from its tangent by at most ½ f² times the bound
/// of its second derivative.
double free_fraction_above(const OutlineBox& own, const StraightMotion& motion, const HalfSpace& below,
                           double tolerance, double limit);

/// Returns that fraction for another box, at rest, instead of a half-space. The separating plane is fixed to whichever
/// of the two boxes gives the larger fraction.
double free_fraction_to(const OutlineBox& own, const StraightMotion& motion, const OutlineBox& other, double tolerance,
                        double limit);

/// Returns that fraction with a new separating plane wherever the last one ends, as long as that leads further: the
/// plane of two boxes that turn towards each other ends although they do not touch.
double free_fraction_past(const OutlineBox& own, const StraightMotion& motion, const OutlineBox& other,
                          double tolerance, double limit);

}  // namespace spring_workbench::geometry
