#pragma once

#include <vector>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::benchmark {

/// The C¹ motion of a handle through the poses of a tracker, as computed by motion::PoseTrack once all of them are
/// known. It is the same for every method that knows the hand only by poses.
class SampledHand {
 public:
  /// `poses`: at least two, in order; the rest frame T of the tip is `length` [m] along the handle's z axis.
  SampledHand(std::vector<motion::PoseSample> poses, double length);

  const std::vector<motion::PoseSample>& poses() const { return poses_; }
  /// The segment that starts at or contains `t`, of the handle H and of T; the last one from its start on.
  const motion::MotionSegment& handle(double t) const { return handle_[index(t)]; }
  const motion::MotionSegment& tip(double t) const { return tip_[index(t)]; }

 private:
  std::size_t index(double t) const;

  std::vector<motion::PoseSample> poses_;
  std::vector<motion::MotionSegment> handle_, tip_;
};

}  // namespace spring_workbench::benchmark
