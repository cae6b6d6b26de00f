#pragma once

#include <deque>
#include <optional>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// Predicts the pose of a tracked frame from its last samples: position and rotation vector are extrapolated along the
/// parabola through the newest sample that fits the samples of the last 140 ms best (least squares); along a line if
/// there are three or fewer.
class PosePredictor {
 public:
  static constexpr double farthest = 0.1;  ///< longest prediction [s]; beyond it, the frame is at rest

  /// Adds a sample, later than the last one.
  void push(const PoseSample& sample);
  /// Forgets all samples, after a jump, a dropout or a loss. The prediction is then at rest until the second new
  /// sample.
  void restart() { samples_.clear(); }

  /// The predicted pose at time `t` [s], but at most `farthest` beyond the newest sample. Nothing if `t` is not later
  /// than the newest sample, or if there is none.
  std::optional<PoseSample> predict(double t) const;

 private:
  std::deque<PoseSample> samples_;  ///< the newest last
};

}  // namespace spring_workbench::motion
