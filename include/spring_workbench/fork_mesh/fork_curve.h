#pragma once

#include <string>
#include <vector>

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::fork_mesh {

/// One place on the curve along which the fork's spring is drawn.
struct CurvePoint {
  Vector3d p = Vector3d::Zero();          ///< [m]
  Vector3d p_rate = Vector3d::UnitZ();    ///< dp/du [m]
  Matrix3d R = Matrix3d::Identity();      ///< local frame (the paper's LCS), z along the curve
  Vector3d turn_rate = Vector3d::Zero();  ///< angular rate of the frame along u, in the axes of the local frame [rad]
};

/// The paper's function f(t) (section 4): a smooth curve with a local frame at every point, from the handle (u = 0) to
/// the tip (u = 1). `u` is the arc length of the rest shape over the rest length. Between the stations that it is made
/// of, positions are cubic and rotations go at a constant rate.
class ForkCurve {
 public:
  /// At least five frames evenly spaced in u, in any one frame. Throws InputError for fewer.
  explicit ForkCurve(std::vector<RigidTransform> stations);

  CurvePoint at(double u) const;
  const RigidTransform& begin() const { return stations_.front(); }
  const RigidTransform& end() const { return stations_.back(); }
  const std::vector<RigidTransform>& stations() const { return stations_; }

 private:
  std::vector<RigidTransform> stations_;
  std::vector<Vector3d> p_rates_;     ///< at the stations, over one interval [m]
  std::vector<Vector3d> turn_rates_;  ///< in the intervals, over one interval [rad]
};

/// The curve of the rod itself: the sections of `shape` with strain `q`, clamped at the pose `X_WH` of the handle; in
/// W.
ForkCurve rod_curve(const rod::ShapeModel& shape, const rod::StrainVector& q, const RigidTransform& X_WH);

/// The paper's arc-length parameterised Bézier curve with compensated length (section 4): from the handle along its z
/// to the tip `X_WE` along the tip's z, both control arms equally long, such that the curve is `arc_length` [m] long.
/// Frames are transported without twist; the remaining rotation to the tip's frame, within half a turn of `twist`
/// [rad], is spread evenly. If no arms give the length (the tip is farther away), they are a third of it.
ForkCurve bezier_curve(const RigidTransform& X_WH, const RigidTransform& X_WE, double arc_length, double twist);

/// The curves that `make_fork_curve` knows: "rod" and "bezier".
const std::vector<std::string>& fork_curve_names();

/// `name` one of fork_curve_names(), else throws InputError; for a rod of `shape` with strain `q`, clamped at `X_WH`.
ForkCurve make_fork_curve(const std::string& name, const rod::ShapeModel& shape, const rod::StrainVector& q,
                          const RigidTransform& X_WH);

}  // namespace spring_workbench::fork_mesh
