#pragma once

#include <limits>
#include <optional>

#include "spring_workbench/motion/pose_predictor.h"

namespace spring_workbench::motion {

/// Predicts where a tracked head is when a picture that is drawn now is seen.
class HeadMotion {
 public:
  /// Returns the pose of the head in F at `latency` [s] from `now` [s, by the steady clock], predicted from the samples
  /// given so far; without latency the newest sample. `X_FH`: the newest sample, of which `stamp` [s] tells whether it
  /// is a new one.
  RigidTransform follow(double stamp, const RigidTransform& X_FH, double now, double latency);

 private:
  PosePredictor predictor_;
  double stamp_ = -std::numeric_limits<double>::infinity();  ///< of the newest sample [s]
  double received_at_ = 0.0;                                 ///< when it was given [s]
};

}  // namespace spring_workbench::motion
