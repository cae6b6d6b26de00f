#include "spring_workbench/motion/stream_monitor.h"

#include <algorithm>
#include <cmath>

#include "constants.h"

namespace spring_workbench::motion {

void StreamMonitor::Spread::add(double x) {
  const double share = 1.0 / static_cast<double>(std::min(++count, monitored_samples));
  const double step = x - mean;
  mean += share * step;
  variance = (1.0 - share) * (variance + share * step * step);
}

void StreamMonitor::sample(double stamp, double receipt) {
  ++figures_.samples;
  figures_.age = receipt - stamp;
  const double interval = stamp - stamp_;
  if (!std::isnan(interval)) {
    figures_.longest_gap = std::max(figures_.longest_gap, interval);
    if (interval <= dropout_after_ && receipt - receipt_ <= dropout_after_) {
      stamps_.add(interval);
      receipts_.add(receipt - receipt_);
    }
  }
  stamp_ = stamp;
  receipt_ = receipt;
  figures_.interval = stamps_.mean;
  figures_.stamp_jitter = std::sqrt(stamps_.variance);
  figures_.receipt_jitter = std::sqrt(receipts_.variance);
}

void StreamMonitor::restart() { stamp_ = receipt_ = std::numeric_limits<double>::quiet_NaN(); }

}  // namespace spring_workbench::motion
