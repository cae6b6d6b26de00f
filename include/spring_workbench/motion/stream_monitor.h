#pragma once

#include <cstddef>
#include <limits>

namespace spring_workbench::motion {

/// How evenly the samples of a station come. Smoothed over some fifty samples.
struct StreamFigures {
  std::size_t samples = 0;
  double interval = 0.0;        ///< mean time between stamps [s]; 0 before the second sample
  double stamp_jitter = 0.0;    ///< standard deviation of it [s]
  double receipt_jitter = 0.0;  ///< standard deviation of the time between receipts [s]
  double age = 0.0;             ///< of the newest sample when it came: receipt less stamp [s]
  double longest_gap = 0.0;     ///< between stamps [s]
};

/// Keeps the figures of a stream of stamps [s] and their receipts [s], both of one clock or each of its own.
class StreamMonitor {
 public:
  /// `dropout_after` [s]: longer gaps do not count as intervals.
  explicit StreamMonitor(double dropout_after) : dropout_after_(dropout_after) {}

  void sample(double stamp, double receipt);
  const StreamFigures& figures() const { return figures_; }
  /// The next sample starts a new stream; the figures stay.
  void restart();

 private:
  /// Mean and variance with exponentially fading weights.
  struct Spread {
    double mean = 0.0, variance = 0.0;
    std::size_t count = 0;
    void add(double x);
  };

  double dropout_after_;
  double stamp_ = std::numeric_limits<double>::quiet_NaN();
  double receipt_ = std::numeric_limits<double>::quiet_NaN();
  Spread stamps_, receipts_;
  StreamFigures figures_;
};

}  // namespace spring_workbench::motion
