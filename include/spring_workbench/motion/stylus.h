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

/// Motion and button edges of one stylus, and the wrench on what it holds, from their samples. With the clutch on, S
/// stays where it is while the hand moves alone; afterwards S continues from there, and moves and turns in world as the
/// hand does.
class Stylus {
 public:
  /// [s]; stamps nearer to each other are one. Smaller: a rounding error makes a step of its own. Test:
  /// Simulation.ACallThatEndsARoundingErrorBesideASampleMakesNoStepOfItsOwn at 0.
  static constexpr double same_time = 1e-9;

  /// `dropout_after` [s]: as for PoseTrack; `wrench_timeout` [s]: as for WrenchTrack. Without a sample it is at
  /// `X_WS_start`.
  Stylus(double dropout_after, double wrench_timeout, const RigidTransform& X_WS_start)
      : track_(dropout_after), wrench_(wrench_timeout), X_WS_start_(X_WS_start), X_WS_(X_WS_start) {}

  /// Forgets samples and buttons.
  void reset() {
    track_.clear();
    presses_.clear();
    wrench_.clear();
    X_WS_ = X_WS_start_;
    clutched_ = displaced_ = false;
  }

  bool push(const PoseSample& sample) { return track_.push(sample); }
  void push(double t, Press press) { presses_.push_back({t, press}); }
  void push(const ExternalWrench& sample) { wrench_.push(sample); }
  const PoseTrack& track() const { return track_; }
  /// Whether its pose at time `now` [s] follows from the samples.
  bool known(double now) const { return !track_.empty() && now >= track_.begin() - same_time; }
  /// Its motion from `now` to the next sample.
  MotionSegment motion(double now) { return of_tool(track_.segment(now)); }
  /// The same before a step has used it: the next sample may still change the velocity at its end.
  MotionSegment provisional(double now) const { return of_tool(track_.provisional(std::max(now, track_.begin()))); }
  /// The time after `now` at which the next segment of the motion begins; infinity if there is none.
  double next_sample(double now) const { return track_.next_after(now); }
  /// Its twist at `now`, world axes; zero where that is not known.
  Twist twist(double now) const {
    if (clutched_ || !known(now)) return {};
    const MotionSegment segment = provisional(now);
    return segment.at(std::max(now, segment.begin())).velocity;
  }
  /// The time after `now` of the next button edge or change of the wrench; infinity where there is none.
  double next_edge(double now) const {
    const bool later = !presses_.empty() && presses_.front().t > now + same_time;
    const double press = later ? presses_.front().t : std::numeric_limits<double>::infinity();
    return std::min(press, wrench_.next_edge(now, same_time));
  }
  /// Goes to the wrench at `now`. Returns whether it has timed out there.
  bool follow_wrench(double now) { return wrench_.follow(now, same_time); }
  /// The wrench at the time of the last follow_wrench(); none: zero.
  const std::optional<ExternalWrench>& wrench() const { return wrench_.present(); }
  /// Takes the next button edge up to `now`, where there is one.
  std::optional<Press> take_press(double now) {
    if (presses_.empty() || presses_.front().t > now + same_time) return std::nullopt;
    const Press press = presses_.front().press;
    presses_.pop_front();
    return press;
  }

  bool clutched() const { return clutched_; }
  /// At `now`, to which it has been followed.
  void set_clutch(bool on, double now) {
    if (clutched_ && !on && known(now)) {
      const RigidTransform X_W = track_.pose(std::max(now, track_.begin()));  // of the hand
      by_ = X_WS_.translation() - X_W.translation();
      turned_ = make_transform(Quaterniond(X_W.linear().transpose() * X_WS_.linear()), Vector3d::Zero());
      displaced_ = true;
    }
    clutched_ = on;
  }

  /// Moves to its pose at `now`, if that is known.
  void follow(double now) {
    if (clutched_ || !known(now)) return;
    X_WS_ = track_.pose(std::max(now, track_.begin()));
    if (displaced_) X_WS_ = of_tool(X_WS_);
  }
  /// The pose that was followed to last.
  const RigidTransform& X_WS() const { return X_WS_; }
  void forget_before(double now) {
    if (!track_.empty() && track_.begin() < now) track_.forget_before(now);
  }

  void exchange(math::StateArchive& state) {
    state(track_, presses_, wrench_, X_WS_, clutched_, displaced_, by_, turned_);
  }

 private:
  struct Edge {
    double t;
    Press press;
    void exchange(math::StateArchive& state) { state(t, press); }
  };
  /// Where S is when the hand is there.
  RigidTransform of_tool(const RigidTransform& X_W) const { return Eigen::Translation3d(by_) * X_W * turned_; }
  /// What S does where the hand moves so: the same cubics between displaced ends.
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
  std::deque<Edge> presses_;
  WrenchTrack wrench_;
  RigidTransform X_WS_start_, X_WS_;
  bool clutched_ = false;
  bool displaced_ = false;  ///< S is not where the hand is, but `by_` away in world, and `turned_` against it
  Vector3d by_ = Vector3d::Zero();
  RigidTransform turned_ = RigidTransform::Identity();
};

}  // namespace spring_workbench::motion
