#pragma once

#include <deque>
#include <optional>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// Predicts the pose of a tracked frame from its last samples: position and rotation vector continue along the curve
/// through the newest sample that fits the others best, in the sense of least squares; a line over the last 30 ms up to
/// 20 ms ahead, a parabola over the last 120 ms beyond.
class PosePredictor {
 public:
  static constexpr double farthest = 0.1;  ///< [s]; it rests beyond

  /// The next sample, later than the last one.
  void push(const PoseSample& sample);
  /// Forgets all, after a jump, a dropout or a loss: the frame rests until the second sample that follows.
  void restart() { samples_.clear(); }

  /// The frame at time `t` [s], or at the farthest time if that is sooner; nothing up to the newest sample, and where
  /// there is none.
  std::optional<PoseSample> predict(double t) const;

 private:
  std::deque<PoseSample> samples_;  ///< the newest last
};

}  // namespace spring_workbench::motion
