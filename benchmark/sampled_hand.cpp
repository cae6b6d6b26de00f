#include "benchmark/sampled_hand.h"

#include <algorithm>
#include <utility>

#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::benchmark {

SampledHand::SampledHand(std::vector<motion::PoseSample> poses, double length) : poses_(std::move(poses)) {
  motion::PoseTrack track;
  for (const motion::PoseSample& sample : poses_) track.push(sample);
  const RigidTransform X_HT = make_transform(length * Vector3d::UnitZ(), Quaterniond::Identity());
  for (std::size_t i = 0; i + 1 < poses_.size(); ++i) {
    handle_.push_back(track.segment(poses_[i].t));
    tip_.push_back(handle_.back().of_frame(X_HT));
  }
}

std::size_t SampledHand::index(double t) const {
  const double span = poses_.back().t - poses_.front().t, share = std::clamp((t - poses_.front().t) / span, 0.0, 1.0);
  const std::size_t last = handle_.size() - 1;
  std::size_t i = std::min(static_cast<std::size_t>(share * static_cast<double>(handle_.size())), last);
  while (i > 0 && t < poses_[i].t) --i;
  while (i < last && t >= poses_[i + 1].t) ++i;
  return i;
}

}  // namespace spring_workbench::benchmark
