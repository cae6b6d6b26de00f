#pragma once

#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::registration {

/// A point whose place on the workbench is known, and where the stylus' tip was when it touched it.
struct Landmark {
  std::string name;
  Vector3d p_B = Vector3d::Zero();  ///< in the workbench [m]
  Vector3d p_T = Vector3d::Zero();  ///< in the tracker's frame [m]
};

/// The tracker's frame T in the workbench B.
struct Registration {
  RigidTransform X_BT = RigidTransform::Identity();
  std::vector<double> residuals;  ///< distance of each landmark from where the touch says it is [m]
  double rms = 0.0;               ///< of the residuals [m]
  double touch_error = 0.0;       ///< standard deviation of a touch along one axis, estimated from the residuals [m]
  double position_error = 0.0;    ///< expected RMS error of a point at the landmarks' middle [m]
  double angle_error = 0.0;       ///< expected RMS angle of the rotation's error [rad]
};

/// Least-squares pose (Umeyama, IEEE PAMI 13(4), 1991, without scale) of at least three landmarks. With touches that
/// are off by σ along each axis, `E[Σ residual²] = (3N − 6) σ²` (Sibson 1979; Fitzpatrick, West, Maurer, IEEE TMI
/// 17(5), 1998), from which the touches' error is estimated; position and angle errors follow by linear propagation: `3
/// σ²/N` and `σ² tr (Σ (|d|² I − d dᵀ))⁻¹`, d from the landmarks' middle. Throws InputError when there are too few, two
/// names are the same, they lie (within a centimetre) on one line, a residual is larger than `largest_residual` [m]
/// (the message names the worst, and the order that would fit if there is one), or, for up to seven landmarks, another
/// order of the touches fits nearly as well: the landmarks are then too symmetric to be distinguished.
Registration register_tracker(const std::vector<Landmark>& landmarks, double largest_residual);

/// Place of the tip in the stylus' frame, found by turning the stylus about its tip, which rests.
struct PivotCalibration {
  Vector3d p_ST = Vector3d::Zero();     ///< tip in the stylus' frame [m]
  Vector3d p_pivot = Vector3d::Zero();  ///< place at which it rested, in the tracker's frame [m]
  double rms = 0.0;                     ///< of the tip's distances from there [m]
};

/// Least squares of `R p_ST + p = p_pivot` over all poses. Throws InputError when there are fewer than ten, when the
/// stylus was turned too little for all three coordinates (by less than about 20° about two axes), or when the rms is
/// above `largest_rms` [m]: the tip has slipped.
PivotCalibration calibrate_tip(const std::vector<RigidTransform>& poses_TS, double largest_rms);

}  // namespace spring_workbench::registration
