#include "spring_workbench/ros_interface/playout_clock.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench {

void PlayoutClock::sample(double t, const LocalTime& arrival) {
  constexpr double share_of_new = 0.1;  // smooths over some ten samples
  const double interval = t - newest_;
  if (std::isfinite(interval) && interval <= dropout_after_) {
    interval_ = interval_ > 0.0 ? interval_ + share_of_new * (interval - interval_) : interval;
  }
  before_newest_ = newest_;
  newest_ = t;
  arrival_ = arrival;
}

double PlayoutClock::target(const LocalTime& now) const {
  constexpr double shortest_silence = 0.2;  // [s] by the wall clock
  const double waited = std::max(now.loop - arrival_.loop, 0.0);
  const double target = newest_ + waited - interval_;
  if (!simulated_time_) return waited > dropout_after_ ? target : std::min(target, newest_);
  const bool silent = waited > dropout_after_ && now.wall - arrival_.wall > shortest_silence;
  return silent ? std::max(target, before_newest_) : before_newest_;
}

}  // namespace spring_workbench
