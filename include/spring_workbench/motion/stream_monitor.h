#pragma once

#include <cstddef>
#include <limits>

namespace spring_workbench::motion {

/// Rate and jitter of the samples of a station, smoothed over about fifty samples.
struct StreamFigures {
  std::size_t samples = 0;
  double interval = 0.0;        ///< mean time between stamps [s]; 0 before the second sample
  double stamp_jitter = 0.0;    ///< standard deviation of the time between stamps [s]
  double receipt_jitter = 0.0;  ///< standard deviation of the time between receipts [s]
  double age = 0.0;             ///< age of the newest sample on arrival: receipt minus stamp [s]
  double longest_gap = 0.0;     ///< longest time between stamps [s]
};

/// Computes the figures of a stream of stamps [s] and their times of receipt [s], from the same or two different
/// clocks.
class StreamMonitor {
 public:
  /// `dropout_after` [s]: longer gaps are not counted as intervals.
  explicit StreamMonitor(double dropout_after) : dropout_after_(dropout_after) {}

  void sample(double stamp, double receipt);
  const StreamFigures& figures() const { return figures_; }
  /// The next sample starts a new stream; the figures stay.
  void restart();

 private:
  /// Mean and variance with exponentially decaying weights.
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
