#pragma once

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>

#include "constants.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::simulation {

/// What one stylus has told: how it moves, and the edges of its buttons.
class Stylus {
 public:
  enum class Press { grasp, release, next_tool };

  /// `dropout_after` [s]: as for PoseTrack. Without a sample it is at `X_WS_start`.
  Stylus(double dropout_after, const RigidTransform& X_WS_start)
      : track_(dropout_after), X_WS_start_(X_WS_start), X_WS_(X_WS_start) {}

  /// Forgets samples and buttons.
  void reset() {
    track_.clear();
    presses_.clear();
    X_WS_ = X_WS_start_;
  }

  bool push(const motion::PoseSample& sample) { return track_.push(sample); }
  void push(double t, Press press) { presses_.push_back({t, press}); }
  const motion::PoseTrack& track() const { return track_; }
  /// Whether a sample says where it is at time `now` [s].
  bool known(double now) const { return !track_.empty() && now >= track_.begin() - same_time; }
  /// Its motion from `now` to the next sample.
  const motion::MotionSegment& motion(double now) { return track_.segment(now); }
  /// The same before it is gone along: the next sample may still say another velocity at its end.
  motion::MotionSegment provisional(double now) const { return track_.provisional(std::max(now, track_.begin())); }
  /// The time after `now` at which the next piece of the motion begins; infinity where there is none.
  double next_sample(double now) const { return track_.next_after(now); }
  /// The time after `now` of the next button edge; infinity where there is none.
  double next_button(double now) const {
    const bool later = !presses_.empty() && presses_.front().t > now + same_time;
    return later ? presses_.front().t : std::numeric_limits<double>::infinity();
  }
  /// Takes the next button edge up to `now`, where there is one.
  std::optional<Press> take_press(double now) {
    if (presses_.empty() || presses_.front().t > now + same_time) return std::nullopt;
    const Press press = presses_.front().press;
    presses_.pop_front();
    return press;
  }

  /// Goes to where it is at `now`, where that is known.
  void follow(double now) {
    if (known(now)) X_WS_ = track_.pose(std::max(now, track_.begin()));
  }
  /// The pose that was followed to last.
  const RigidTransform& X_WS() const { return X_WS_; }
  void forget_before(double now) {
    if (!track_.empty() && track_.begin() < now) track_.forget_before(now);
  }

  void exchange(math::StateArchive& state) { state(track_, presses_, X_WS_); }

 private:
  struct Edge {
    double t;
    Press press;
    void exchange(math::StateArchive& state) { state(t, press); }
  };
  motion::PoseTrack track_;
  std::deque<Edge> presses_;
  RigidTransform X_WS_start_, X_WS_;
};

}  // namespace spring_workbench::simulation
