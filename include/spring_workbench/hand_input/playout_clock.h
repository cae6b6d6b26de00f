#pragma once

#include <limits>

#include "spring_workbench/hand_input/local_time.h"

namespace spring_workbench::hand_input {

/// Determines up to which time the input of one hand is complete. Poses are complete up to the last sample but one,
/// because the velocity there depends on the newest sample. Buttons, while button messages keep arriving, are complete
/// up to the newest of them, so a button takes effect at its own stamp. The motion of a hand therefore depends only on
/// the messages, not on when they are read.
///
/// A hand that has been silent for longer than `dropout_after` rests, and its input counts as complete. The silence
/// must also have lasted 0.2 s of running time, so that a bag played quickly or a process that was stopped does not
/// look like a lost hand. No common clock with the tracker is needed, because only intervals of the local clock count.
class PlayoutClock {
 public:
  /// `dropout_after` [s], > 0: silence after which the hand rests.
  explicit PlayoutClock(double dropout_after) : dropout_after_(dropout_after) {}

  /// Reports the arrival of a sample with stamp `t` [s].
  void add_sample(double t, const LocalTime& arrival);
  /// Reports the arrival of a sample that is dropped.
  void report_arrival(const LocalTime& arrival) { arrival_ = arrival; }
  /// Reports that the buttons are known up to `t` [s].
  void confirm_buttons(double t, const LocalTime& arrival);
  /// Returns the time up to which the input is complete [s]: −infinity before the second sample, infinity while the
  /// hand is silent.
  double complete_until(const LocalTime& now) const;
  /// Returns the time [s] up to which a silent hand is known to rest: local time less one sample interval, because its
  /// samples were that far behind, too; −infinity before the first sample.
  double rests_until(const LocalTime& now) const;
  /// Stamp of the newest sample [s], and time since the last arrival [s].
  double newest() const { return newest_; }
  double time_since_arrival(const LocalTime& now) const;
  /// Forgets all samples and the state of the buttons, but remembers whether button messages have ever arrived.
  void clear();

 private:
  double dropout_after_;
  double newest_ = -std::numeric_limits<double>::infinity();
  double before_newest_ = -std::numeric_limits<double>::infinity();
  LocalTime arrival_;
  double buttons_until_ = -std::numeric_limits<double>::infinity();
  double buttons_arrival_ = -std::numeric_limits<double>::infinity();  ///< in running time
  double interval_ = 0.0;                                              ///< smoothed time between samples [s]
};

}  // namespace spring_workbench::hand_input
