#pragma once

#include <optional>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::hand_input {

/// Keeps a hand that only trembles at rest. A hand that stays within `dead_band_distance` and `dead_band_angle` of one
/// pose for 0.3 s rests: the followed pose is bit-identical from then on, until the tracked one is farther from it than
/// that. Then it is dragged along at that distance, which shrinks with a time constant of 0.1 s. The followed pose is
/// therefore never farther than the band from the tracked one, does not jump, and is the tracked one during motion. A
/// band of 0 for position or rotation leaves it unfiltered.
class DeadBand {
 public:
  explicit DeadBand(const InputSettings& settings) : settings_(settings) {}

  /// The next sample (later than the last one): its pose as followed, its stamp as it is.
  motion::PoseSample filter(const motion::PoseSample& sample);
  /// The next sample is followed exactly.
  void restart() { followed_.reset(); }

 private:
  bool within_band(const RigidTransform& X, const RigidTransform& of) const;
  void drag(const RigidTransform& X);

  InputSettings settings_;
  std::optional<motion::PoseSample> followed_;
  motion::PoseSample still_;  ///< the pose that the hand has been at, and since when
  bool rests_ = false;
  double play_ = 0.0;  ///< of the dragged pose: fraction of the band
};

}  // namespace spring_workbench::hand_input
