#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace spring_workbench::fastrak {

/// Stamps the samples of a device that measures at a constant rate, from their times of receipt.
///
/// Sample k is received at `offset + k interval (1 + drift) + delay_k`, where the delay is never negative. The line
/// that supports all receipts from below is therefore the device's own time plus the smallest delay. It is the edge
/// over the middle of the lower convex hull of the last ten seconds (Moon, Skelly and Towsley, INFOCOM 1999; Zhang, Liu
/// and Xia, INFOCOM 2002). A stamp lies on that line, is never after its receipt, and is later than the previous stamp.
///
/// Lost records show as receipts that stay late by whole intervals. After half a second of these (at least 16), or at
/// once after a silence, the sample count skips ahead to match the line. This is undone if the records still arrive
/// within two seconds.
class CadenceClock {
 public:
  /// `interval` [s], > 0: nominal time between samples, which may be wrong by 0.5 %.
  explicit CadenceClock(double interval) : interval_(interval) {}

  /// Returns the stamp [s] of the next sample, received at `receipt` [s] by the same clock.
  double stamp(double receipt);
  /// Relative excess of the device's interval over the nominal one.
  double drift() const { return slope_ / interval_; }
  /// Whether no interval within 0.5 % of the nominal one has been found after ten seconds.
  bool has_wrong_interval() const;
  /// Forgets all receipts.
  void restart() { *this = CadenceClock(interval_); }

 private:
  /// A receipt: its number, and its delay relative to `interval_`, counted from the first one.
  struct Point {
    double k;
    double late;  ///< [s]
  };

  struct Receipt {
    double t;     ///< [s]
    double late;  ///< relative to the line [s]
  };

  double line(double k) const { return level_ + slope_ * k; }
  void recount(double receipt);
  bool is_even(const std::deque<Receipt>& receipts) const;
  void add(const Point& point);
  void fit();

  double interval_;
  double first_ = 0.0;              ///< receipt of sample 0 [s]
  double k_ = -1.0;                 ///< number of the newest sample
  double receipt_ = 0.0;            ///< newest [s]
  double stamp_ = 0.0;              ///< newest [s]
  double level_ = 0.0;              ///< offset of the line at k = 0 [s]
  double slope_ = 0.0;              ///< slope of the line per sample [s]
  std::deque<Point> quickest_;      ///< the receipt with the smallest delay in each half second
  double bucket_end_ = 0.0;         ///< number of the sample that begins the next half second
  std::deque<Receipt> recent_;      ///< the last half second
  double skipped_intervals_ = 0.0;  ///< samples by which the count was last advanced
  double skipped_at_ = 0.0;         ///< number of the sample at which it was
};

}  // namespace spring_workbench::fastrak
