#include "spring_workbench/ros_interface/playout_clock.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench {

void PlayoutClock::sample(double t, double arrival) {
  constexpr double share_of_new = 0.1;  // smooths over some ten samples
  const double interval = t - newest_;
  if (std::isfinite(interval) && interval <= dropout_after_) {
    interval_ = interval_ > 0.0 ? interval_ + share_of_new * (interval - interval_) : interval;
  }
  newest_ = t;
  arrival_ = arrival;
}

double PlayoutClock::target(double now) const {
  const double waited = std::max(now - arrival_, 0.0);
  const double target = newest_ + waited - interval_;
  return waited > dropout_after_ ? target : std::min(target, newest_);
}

}  // namespace spring_workbench
