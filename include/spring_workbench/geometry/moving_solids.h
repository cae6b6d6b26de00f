#pragma once

#include <limits>
#include <vector>

#include "spring_workbench/geometry/box_contacts.h"
#include "spring_workbench/geometry/solid_contacts.h"

namespace spring_workbench::geometry {

/// Steady motion of a body over a step.
struct SteadyMotion {
  Vector3d p_W = Vector3d::Zero();                          ///< a point of it [m]
  Vector3d v_W = Vector3d::Zero(), w_W = Vector3d::Zero();  ///< its velocity [m/s], and that of rotation [rad/s]
  double radius = std::numeric_limits<double>::infinity();  ///< no point of the body is further from it [m]

  Vector3d velocity_at(const Vector3d& q_W) const { return v_W + w_W.cross(q_W - p_W); }
  /// Pose of a part of the body after `h` [s].
  RigidTransform moved(const RigidTransform& X_WS, double h) const;
};

/// Largest speed at which points of two bodies can approach each other, as seen from one of them [m/s].
double approach_speed(const SteadyMotion& a, const SteadyMotion& b);

/// Turns the normals of contacts wider than `min_gap` that the solids' motion over `h` [s] would close although it
/// leads past the other: to be perpendicular to the motion, if the planes there separate the solids all the time.
void let_pass(const Solid& a, const RigidTransform& X_WA, const SteadyMotion& motion_a, const Solid& b,
              const RigidTransform& X_WB, const SteadyMotion& motion_b, double h, double min_gap,
              std::vector<BoxContact>& contacts);

}  // namespace spring_workbench::geometry
