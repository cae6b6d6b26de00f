#pragma once

#include <limits>

namespace spring_workbench {

/// Says how far to simulate: one sample interval behind the tracker as long as samples come, so that every segment of
/// the hand's motion is known before it is walked; and on past the newest sample, the hand held at rest, once they have
/// stopped for longer than `dropout_after`. Needs no common clock with the tracker: only intervals of the local one
/// count.
class PlayoutClock {
 public:
  /// `dropout_after` [s], > 0.
  explicit PlayoutClock(double dropout_after) : dropout_after_(dropout_after) {}

  /// A sample stamped `t` [s] (later than the last one) came at local time `arrival` [s].
  void sample(double t, double arrival);
  /// The time to simulate to [s] at local time `now` [s]; −infinity before the first sample.
  double target(double now) const;
  /// Forgets all samples.
  void clear() { *this = PlayoutClock(dropout_after_); }

 private:
  double dropout_after_;
  double newest_ = -std::numeric_limits<double>::infinity();
  double arrival_ = 0.0;
  double interval_ = 0.0;  ///< smoothed time between samples [s]
};

}  // namespace spring_workbench
