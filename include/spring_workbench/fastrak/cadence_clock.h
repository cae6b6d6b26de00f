#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace spring_workbench::fastrak {

/// Stamps the samples of a device that measures at an even rate, from the moments at which they are received.
///
/// Receipt k comes at `offset + k interval (1 + drift) + delay_k` with a delay that is never negative. The line under
/// all receipts that touches them where they are quickest is therefore the device's own time, but for the smallest
/// delay: the lower convex hull of the last ten seconds, of which the edge over the middle is taken (Moon, Skelly and
/// Towsley, INFOCOM 1999; Zhang, Liu and Xia, INFOCOM 2002). A stamp is on that line, never after its receipt, and
/// later than the stamp before.
///
/// Lost records show as receipts that stay late by whole intervals. After half a second of them (16 at least), or at
/// once after a silence, the count continues from where the line is; this is undone if the records still come within
/// two seconds.
class CadenceClock {
 public:
  /// `interval` [s], > 0: between samples by the device's description; may be wrong by 0.5 %.
  explicit CadenceClock(double interval) : interval_(interval) {}

  /// Stamp [s] of the next sample, received at `receipt` [s] of the same clock.
  double stamp(double receipt);
  /// Relative to the interval given, how much longer the device's is.
  double drift() const { return slope_ / interval_; }
  /// Whether after ten seconds the device's interval still is not found within 0.5 % of the one given.
  bool is_astray() const;
  /// Forgets all receipts.
  void restart() { *this = CadenceClock(interval_); }

 private:
  /// A receipt: its number, and how much later it came than `interval_` says, counted from the first one.
  struct Point {
    double k;
    double late;  ///< [s]
  };

  struct Receipt {
    double t;     ///< [s]
    double late;  ///< against the line [s]
  };

  double line(double k) const { return level_ + slope_ * k; }
  void recount(double receipt);
  bool is_even(const std::deque<Receipt>& receipts) const;
  void add(const Point& point);
  void fit();

  double interval_;
  double first_ = 0.0;          ///< receipt of sample 0 [s]
  double k_ = -1.0;             ///< number of the newest sample
  double receipt_ = 0.0;        ///< newest [s]
  double stamp_ = 0.0;          ///< newest [s]
  double level_ = 0.0;          ///< of the line at k = 0 [s]
  double slope_ = 0.0;          ///< of the line per sample [s]
  std::deque<Point> quickest_;  ///< the quickest receipt of each half second
  double bucket_end_ = 0.0;     ///< number of the sample that begins the next half second
  std::deque<Receipt> recent_;  ///< the last half second
  double counted_on_ = 0.0;     ///< samples by which the count went on lately
  double counted_on_at_ = 0.0;  ///< number of the sample
};

}  // namespace spring_workbench::fastrak
