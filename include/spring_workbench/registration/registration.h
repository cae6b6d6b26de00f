#pragma once

#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::registration {

/// A point whose position on the workbench is known, and the position of the stylus tip when it touched the point.
struct Landmark {
  std::string name;
  Vector3d p_B = Vector3d::Zero();  ///< in the workbench [m]
  Vector3d p_T = Vector3d::Zero();  ///< in the tracker's frame [m]
};

/// Pose of the tracker's frame T in the workbench frame B, with its accuracy.
struct Registration {
  RigidTransform X_BT = RigidTransform::Identity();
  std::vector<double> residuals;  ///< distance of each landmark from its touch after the fit [m]
  double rms = 0.0;               ///< root mean square of the residuals [m]
  double touch_error = 0.0;       ///< standard deviation of a touch along one axis, estimated from the residuals [m]
  double position_error = 0.0;    ///< expected RMS error of a point at the centroid of the landmarks [m]
  double angle_error = 0.0;       ///< expected RMS error of the rotation [rad]
};

/// Least-squares pose (Umeyama, IEEE PAMI 13(4), 1991, without scale) of at least three landmarks. If touches have an
/// error with standard deviation σ along each axis, `E[Σ residual²] = (3N − 6) σ²` (Sibson 1979; Fitzpatrick, West,
/// Maurer, IEEE TMI 17(5), 1998), which gives an estimate of σ. Position and angle errors follow by linear propagation:
/// `3 σ²/N` and `σ² tr (Σ (|d|² I − d dᵀ))⁻¹`, with d from the centroid of the landmarks. Throws InputError if there
/// are too few landmarks, if two have the same name, if they are collinear (within a centimetre), if a residual is
/// larger than `largest_residual` [m] (the message names the worst one, and an order of the touches that would fit, if
/// there is one), or, for up to seven landmarks, if another order of the touches fits nearly as well, because the
/// landmarks are then too symmetric to be distinguished.
Registration register_tracker(const std::vector<Landmark>& landmarks, double largest_residual);

/// Position of the tip in the stylus frame, found by pivoting the stylus about its resting tip.
struct PivotCalibration {
  Vector3d p_ST = Vector3d::Zero();     ///< tip in the stylus' frame [m]
  Vector3d p_pivot = Vector3d::Zero();  ///< position at which the tip rested, in the tracker's frame [m]
  double rms = 0.0;                     ///< root mean square distance of the tip from `p_pivot` [m]
};

/// Least-squares solution of `R p_ST + p = p_pivot` over all poses. Throws InputError if there are fewer than ten
/// poses, if the stylus was turned too little to determine all three coordinates (by less than about 20° about two
/// axes), or if the RMS is above `largest_rms` [m], because the tip has slipped.
PivotCalibration calibrate_tip(const std::vector<RigidTransform>& poses_TS, double largest_rms);

}  // namespace spring_workbench::registration
