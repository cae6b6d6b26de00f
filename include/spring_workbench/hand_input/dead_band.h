#pragma once

#include <optional>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::hand_input {

/// Suppresses the tremor of a hand at rest. A hand that stays within `dead_band_distance` and `dead_band_angle` of one
/// pose for 0.3 s counts as at rest: the followed pose then stays constant (bit-identical) until the tracked pose is
/// farther away than that. The followed pose is then dragged along at that distance, which decays with a time constant
/// of 0.1 s. So it is never farther than the band from the tracked pose, does not jump, and equals the tracked pose
/// during motion. A band of 0 for position or rotation leaves it unfiltered.
class DeadBand {
 public:
  explicit DeadBand(const InputSettings& settings) : settings_(settings) {}

  /// Returns the next sample (later than the last one) with the followed pose and unchanged stamp.
  motion::PoseSample filter(const motion::PoseSample& sample);
  /// Restarts the filter: the next sample is followed exactly.
  void restart() { followed_.reset(); }

 private:
  bool within_band(const RigidTransform& X, const RigidTransform& of) const;
  void drag(const RigidTransform& X);

  InputSettings settings_;
  std::optional<motion::PoseSample> followed_;
  motion::PoseSample still_;  ///< pose near which the hand has stayed, and the time since when it has
  bool rests_ = false;
  double play_ = 0.0;  ///< distance of the dragged pose from the tracked one, as a fraction of the band
};

}  // namespace spring_workbench::hand_input
