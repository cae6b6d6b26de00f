#pragma once

#include <limits>
#include <optional>

#include "spring_workbench/motion/pose_predictor.h"

namespace spring_workbench::motion {

/// Predicts the pose of a tracked head at the time at which a picture that is drawn now will be seen.
class HeadMotion {
 public:
  /// Returns the pose of the head in F at `latency` [s] from `now` [s, by the steady clock], predicted from the samples
  /// given so far; without latency the newest sample. `X_FH`: the newest sample; it is a new one if its `stamp` [s]
  /// differs from the last one's.
  RigidTransform follow(double stamp, const RigidTransform& X_FH, double now, double latency);

 private:
  PosePredictor predictor_;
  double stamp_ = -std::numeric_limits<double>::infinity();  ///< of the newest sample [s]
  double received_at_ = 0.0;                                 ///< when it was given [s]
};

}  // namespace spring_workbench::motion
