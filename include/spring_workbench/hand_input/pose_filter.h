#pragma once

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::hand_input {

/// Removes jitter from a pose, if enabled in the settings, by the One Euro filter (Casiez, Roussel, Vogel, CHI 2012): a
/// first-order low-pass whose cut-off increases with speed, `f_c = min_cutoff + beta |v|`, so that a hand at rest does
/// not tremble and a fast one does not lag. Position is filtered by component, with the norm of the velocity; rotation
/// along the shortest arc, with the turn rate.
class PoseFilter {
 public:
  explicit PoseFilter(const InputSettings& settings) : settings_(settings) {}

  /// Returns the next sample (later than the last one) with filtered pose and unchanged stamp.
  motion::PoseSample filter(const motion::PoseSample& sample);
  /// The next sample starts the filter again.
  void restart() { running_ = false; }

 private:
  bool running_ = false;
  InputSettings settings_;
  motion::PoseSample raw_;           ///< the newest sample
  RigidTransform X_;                 ///< filtered
  Vector3d v_ = Vector3d::Zero();    ///< low-passed velocity [m/s]
  Vector3d w_B_ = Vector3d::Zero();  ///< low-passed turn rate, body axes [rad/s]
};

}  // namespace spring_workbench::hand_input
