#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

#include "spring_workbench/motion/external_wrench.h"
#include "spring_workbench/motion/pose_track.h"
#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::motion {

/// Motion and button edges of one stylus, and the external wrench on the object that it holds, from their samples.
/// While the clutch is on, the stylus frame S stays in place and the hand moves alone; afterwards S continues from
/// there, and moves and turns in world as the hand does.
class Stylus {
 public:
  /// [s]; stamps closer to each other count as equal. Smaller: a rounding error makes an extra step. Test:
  /// Simulation.ARoundingErrorBetweenEndAndSampleAddsNoStep at 0.
  static constexpr double same_time = 1e-9;

  /// `dropout_after` [s]: see PoseTrack; `wrench_timeout` [s]: see WrenchTrack. Before the first sample the stylus is
  /// at `X_WS_start`.
  Stylus(double dropout_after, double wrench_timeout, const RigidTransform& X_WS_start)
      : track_(dropout_after), wrench_(wrench_timeout), X_WS_start_(X_WS_start), X_WS_(X_WS_start) {}

  /// Forgets samples and buttons.
  void reset() {
    track_.clear();
    edges_.clear();
    wrench_.clear();
    X_WS_ = X_WS_start_;
    clutched_ = displaced_ = false;
  }

  bool push(const PoseSample& sample) { return track_.push(sample); }
  void push(double t, ButtonEdge edge) {
    auto at = edges_.end();
    while (at != edges_.begin() && std::prev(at)->t > t) --at;
    edges_.insert(at, {t, edge});
  }
  void push(const ExternalWrench& sample) { wrench_.push(sample); }
  const PoseTrack& track() const { return track_; }
  /// Time of the oldest sample still held [s]; infinity if there is none.
  double first_sample() const { return track_.empty() ? std::numeric_limits<double>::infinity() : track_.begin(); }
  /// Whether its pose at time `now` [s] is known from samples.
  bool known(double now) const { return !track_.empty() && now >= track_.begin() - same_time; }
  /// Returns its motion from `now` to the next sample; a sample that is later than `now` only by rounding is skipped.
  MotionSegment motion(double now) { return of_tool(track_.segment(std::max(now + same_time, track_.begin()))); }
  /// Returns the motion as known so far: the next sample may still change the velocity at its end.
  MotionSegment provisional(double now) const { return of_tool(track_.provisional(std::max(now, track_.begin()))); }
  /// The time after `now` at which the next segment of the motion begins; infinity if there is none.
  double next_sample(double now) const { return track_.next_after(now); }
  /// Its twist at `now`, world axes; zero if that is not known.
  Twist twist(double now) const {
    if (clutched_ || !known(now)) return {};
    const MotionSegment segment = provisional(now);
    return segment.at(std::max(now, segment.begin())).velocity;
  }
  /// The time after `now` of the next button edge or change of the wrench; infinity if there is none.
  double next_event_time(double now) const {
    const bool later = !edges_.empty() && edges_.front().t > now + same_time;
    const double edge = later ? edges_.front().t : std::numeric_limits<double>::infinity();
    return std::min(edge, wrench_.next_change_time(now, same_time));
  }
  /// Updates the wrench to time `now`. Returns whether it has just timed out.
  bool follow_wrench(double now) { return wrench_.advance_to(now, same_time); }
  /// The wrench at the time of the last follow_wrench(); none if it is zero.
  const std::optional<ExternalWrench>& wrench() const { return wrench_.present(); }
  /// Takes the next button edge up to `now`, if there is one.
  std::optional<ButtonEdge> take_edge(double now) {
    if (edges_.empty() || edges_.front().t > now + same_time) return std::nullopt;
    const ButtonEdge edge = edges_.front().edge;
    edges_.pop_front();
    return edge;
  }

  bool clutched() const { return clutched_; }
  /// Switches the clutch at `now`, the time of the last advance_to().
  void set_clutch(bool on, double now) {
    if (clutched_ && !on && known(now)) {
      const RigidTransform X_W = track_.pose(std::max(now, track_.begin()));  // of the hand
      offset_W_ = X_WS_.translation() - X_W.translation();
      rotation_offset_ = make_transform(Vector3d::Zero(), Quaterniond(X_W.linear().transpose() * X_WS_.linear()));
      displaced_ = true;
    }
    clutched_ = on;
  }

  /// Moves the stylus to its pose at `now`, if that is known.
  void advance_to(double now) {
    if (clutched_ || !known(now)) return;
    X_WS_ = track_.pose(std::max(now, track_.begin()));
    if (displaced_) X_WS_ = of_tool(X_WS_);
  }
  /// The pose at the last advance_to().
  const RigidTransform& X_WS() const { return X_WS_; }
  void forget_before(double now) {
    if (!track_.empty() && track_.begin() < now) track_.forget_before(now);
  }

  void archive(math::StateArchive& state) {
    state(track_, edges_, wrench_, X_WS_, clutched_, displaced_, offset_W_, rotation_offset_);
  }

 private:
  struct Edge {
    double t;
    ButtonEdge edge;
    void archive(math::StateArchive& state) { state(t, edge); }
  };
  /// The pose of S for this pose of the hand.
  RigidTransform of_tool(const RigidTransform& X_W) const {
    return Eigen::Translation3d(offset_W_) * X_W * rotation_offset_;
  }
  /// The motion of S for this motion of the hand: the same cubics between displaced ends.
  MotionSegment of_tool(const MotionSegment& hand) const {
    if (clutched_) return MotionSegment(X_WS_);
    if (!displaced_) return hand;
    const MotionState a = hand.at(hand.begin());
    const PoseSample begin{hand.begin(), of_tool(a.X)};
    if (std::isinf(hand.end())) return MotionSegment(begin.X, begin.t);
    const MotionState b = hand.at(hand.end());
    const PoseSample end{hand.end(), of_tool(b.X)};
    return MotionSegment(begin, a.velocity.linear, begin.X.linear().transpose() * a.velocity.angular, end,
                         b.velocity.linear, end.X.linear().transpose() * b.velocity.angular);
  }

  PoseTrack track_;
  std::deque<Edge> edges_;
  WrenchTrack wrench_;
  RigidTransform X_WS_start_, X_WS_;
  bool clutched_ = false;
  bool displaced_ = false;  ///< S is displaced from the hand by `offset_W_` in world and rotated by `rotation_offset_`
  Vector3d offset_W_ = Vector3d::Zero();
  RigidTransform rotation_offset_ = RigidTransform::Identity();
};

}  // namespace spring_workbench::motion
