#include "spring_workbench/hand_input/playout_clock.h"

#include <algorithm>
#include <cmath>

#include "constants.h"

namespace spring_workbench::hand_input {

void PlayoutClock::add_sample(double t, const LocalTime& arrival) {
  const double interval = t - newest_;
  if (std::isfinite(interval) && interval <= dropout_after_) {
    interval_ = interval_ > 0.0 ? interval_ + new_interval_weight * (interval - interval_) : interval;
  }
  before_newest_ = newest_;
  newest_ = t;
  arrival_ = arrival;
}

double PlayoutClock::time_since_arrival(const LocalTime& now) const { return std::max(now.loop - arrival_.loop, 0.0); }

double PlayoutClock::complete_until(const LocalTime& now) const {
  const bool silent = time_since_arrival(now) > dropout_after_ && now.running - arrival_.running > shortest_silence;
  if (silent && std::isfinite(newest_)) return std::numeric_limits<double>::infinity();
  const bool buttons_come = now.running - buttons_arrival_ < shortest_silence;
  return buttons_come ? std::min(before_newest_, buttons_until_) : before_newest_;
}

double PlayoutClock::rests_until(const LocalTime& now) const { return newest_ + time_since_arrival(now) - interval_; }

void PlayoutClock::confirm_buttons(double t, const LocalTime& arrival) {
  buttons_until_ = std::max(buttons_until_, t);
  buttons_arrival_ = arrival.running;
}

void PlayoutClock::clear() {
  const double buttons_arrival = buttons_arrival_;
  *this = PlayoutClock(dropout_after_);
  buttons_arrival_ = buttons_arrival;
}

}  // namespace spring_workbench::hand_input
