#pragma once

#include <deque>
#include <optional>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// Predicts the pose of a tracked frame from its last samples: position and rotation vector continue along the parabola
/// through the newest sample that fits those of the last 140 ms best, in the sense of least squares; of three samples
/// or fewer, along the line.
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
