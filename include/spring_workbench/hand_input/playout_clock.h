#pragma once

#include <limits>

#include "spring_workbench/hand_input/local_time.h"

namespace spring_workbench::hand_input {

/// Says up to when all is known of one hand. Its motion is known up to the sample before the newest, whose velocity
/// hangs on the newest; its buttons, as long as messages about them come, up to the newest of these, so that a button
/// takes effect at its own stamp, by whatever way it comes. So it depends on the messages alone when a hand does what,
/// and not on the moments at which anybody looks.
///
/// A hand that has been silent for longer than `dropout_after` rests, and nothing more is waited for. That must also
/// have lasted 0.2 s of attended time, so that a bag played quickly, or a process that stood, is not taken for a hand
/// that is lost. Needs no common clock with the tracker: only intervals of the local one count.
class PlayoutClock {
 public:
  /// `dropout_after` [s], > 0.
  explicit PlayoutClock(double dropout_after) : dropout_after_(dropout_after) {}

  /// A sample stamped `t` [s] came.
  void sample(double t, const LocalTime& arrival);
  /// One came that is not used.
  void heard(const LocalTime& arrival) { arrival_ = arrival; }
  /// The buttons are known up to `t` [s].
  void buttons(double t, const LocalTime& arrival);
  /// The time up to which all is known [s]: −infinity before the second sample, infinity while the hand is silent.
  double known_until(const LocalTime& now) const;
  /// Where a silent hand's time is by the local clock, an interval behind as its samples were [s]; −infinity before the
  /// first sample.
  double rests_until(const LocalTime& now) const;
  /// The newest sample's stamp, and how long ago it came [s].
  double newest() const { return newest_; }
  double waited(const LocalTime& now) const;
  /// Forgets all samples; of the buttons, all but that there are some.
  void clear();

 private:
  double dropout_after_;
  double newest_ = -std::numeric_limits<double>::infinity();
  double before_newest_ = -std::numeric_limits<double>::infinity();
  LocalTime arrival_;
  double buttons_until_ = -std::numeric_limits<double>::infinity();
  double buttons_arrival_ = -std::numeric_limits<double>::infinity();  ///< in attended time
  double interval_ = 0.0;                                              ///< smoothed time between samples [s]
};

}  // namespace spring_workbench::hand_input
