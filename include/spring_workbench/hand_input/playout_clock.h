#pragma once

#include <limits>

#include "spring_workbench/hand_input/local_time.h"

namespace spring_workbench::hand_input {

/// Says how far to simulate: one sample interval behind the tracker as long as samples come, so that every segment of
/// the hand's motion is known before it is walked; and on past the newest sample, the hand held at rest, once they have
/// stopped for longer than `dropout_after`. Needs no common clock with the tracker: only intervals of the local one
/// count.
///
/// In simulated time, where messages and clock come at moments of their own, it never goes past the sample before the
/// newest, so that what is simulated depends on the samples alone; and silence must also have lasted 0.2 s of attended
/// time, so that a bag played quickly is not taken for one that stopped. While messages about buttons come it does not
/// go past the newest of these either, so that a button takes effect at its own stamp, by whatever way it comes.
class PlayoutClock {
 public:
  /// `dropout_after` [s], > 0. `simulated_time`: whether the local clock is ROS time that somebody publishes.
  explicit PlayoutClock(double dropout_after, bool simulated_time = false)
      : dropout_after_(dropout_after), simulated_time_(simulated_time) {}

  /// A sample stamped `t` [s] came.
  void sample(double t, const LocalTime& arrival);
  /// The buttons are known up to `t` [s].
  void buttons(double t, const LocalTime& arrival);
  /// The time to simulate to [s]; −infinity before the first sample.
  double target(const LocalTime& now) const;
  /// Forgets all samples; of the buttons, all but that there are some.
  void clear();

 private:
  double dropout_after_;
  bool simulated_time_;
  double newest_ = -std::numeric_limits<double>::infinity();
  double before_newest_ = -std::numeric_limits<double>::infinity();
  LocalTime arrival_;
  double buttons_until_ = -std::numeric_limits<double>::infinity();
  double buttons_arrival_ = -std::numeric_limits<double>::infinity();  ///< in attended time
  double interval_ = 0.0;                                              ///< smoothed time between samples [s]
};

}  // namespace spring_workbench::hand_input
