#pragma once

#include <string>
#include <vector>

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::fork_mesh {

/// A point on the curve along which the fork's spring is drawn.
struct CurvePoint {
  Vector3d p = Vector3d::Zero();          ///< [m]
  Vector3d p_rate = Vector3d::UnitZ();    ///< dp/du [m]
  Matrix3d R = Matrix3d::Identity();      ///< local frame (the paper's LCS), z along the curve
  Vector3d turn_rate = Vector3d::Zero();  ///< angular rate of the frame along u, in the axes of the local frame [rad]
};

/// The paper's function f(t) (section 4): a smooth curve with a local frame at every point, from the handle (u = 0) to
/// the tip (u = 1). `u` is arc length of the rest shape divided by the rest length. Between its stations, positions are
/// interpolated cubically and frames rotate at a constant rate.
class ForkCurve {
 public:
  /// `stations`: at least five frames evenly spaced in u, all in the same reference frame. Throws InputError for fewer.
  explicit ForkCurve(std::vector<RigidTransform> stations);

  CurvePoint at(double u) const;
  const RigidTransform& begin() const { return stations_.front(); }
  const RigidTransform& end() const { return stations_.back(); }
  const std::vector<RigidTransform>& stations() const { return stations_; }

 private:
  std::vector<RigidTransform> stations_;
  std::vector<Vector3d> p_rates_;     ///< at the stations, per interval [m]
  std::vector<Vector3d> turn_rates_;  ///< in each interval, per interval [rad]
};

/// The curve of the rod itself, in W: the sections of `shape` at strain `q`, clamped to the handle at `X_WH`.
ForkCurve rod_curve(const rod::ShapeModel& shape, const rod::StrainVector& q, const RigidTransform& X_WH);

/// The paper's arc-length parameterised Bézier curve with compensated length (section 4). It leaves the handle along
/// its z axis and arrives at the tip `X_WE` along the tip's z axis. Both control arms have the same length, chosen such
/// that the curve is `arc_length` [m] long; if the tip is too far away for that, a third of `arc_length`. Frames are
/// transported without twist, and the remaining rotation to the tip's frame, within half a turn of `twist` [rad], is
/// distributed evenly.
ForkCurve bezier_curve(const RigidTransform& X_WH, const RigidTransform& X_WE, double arc_length, double twist);

/// The names that `make_fork_curve` accepts: "rod" and "bezier".
const std::vector<std::string>& fork_curve_names();

/// The curve called `name` for a rod of `shape` at strain `q`, clamped at `X_WH`. Throws InputError if `name` is not
/// one of fork_curve_names().
ForkCurve make_fork_curve(const std::string& name, const rod::ShapeModel& shape, const rod::StrainVector& q,
                          const RigidTransform& X_WH);

}  // namespace spring_workbench::fork_mesh
