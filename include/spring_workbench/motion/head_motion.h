#pragma once

#include <limits>
#include <optional>

#include "spring_workbench/motion/pose_predictor.h"

namespace spring_workbench::motion {

/// Predicts the pose of a tracked head for the moment at which a frame that is rendered now will be visible.
class HeadMotion {
 public:
  /// Returns the pose of the head in F, predicted from the samples so far for the time `latency` [s] after `now` [s,
  /// steady clock]; with latency 0, the newest sample. `X_FH`: the newest sample, which is new if its `stamp` [s]
  /// differs from the last one.
  RigidTransform update(double stamp, const RigidTransform& X_FH, double now, double latency);

 private:
  PosePredictor predictor_;
  double stamp_ = -std::numeric_limits<double>::infinity();  ///< stamp of the newest sample [s]
  double received_at_ = 0.0;                                 ///< time at which it was given [s]
};

}  // namespace spring_workbench::motion
