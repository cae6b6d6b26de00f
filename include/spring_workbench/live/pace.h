#pragma once

#include <algorithm>

namespace spring_workbench::live {

/// Measures how much processor time the simulation needs and whether it keeps up with the hands. While it is behind,
/// simulated time is slower than that of the hands, and no sample is accepted until all accepted ones are simulated.
class Pace {
 public:
  /// Reports a commit that simulated `simulated` [s] and took `took` [s] of the steady clock. `lag`: the time from
  /// there to the newest sample that is still to be simulated [s].
  void committed(double simulated, double took, double lag);
  /// Reports that all accepted samples are simulated.
  void caught_up() { behind_ = false; }
  bool is_behind() const { return behind_; }
  /// Returns the time [s] that it takes to simulate `time` [s].
  double work(double time) const { return cost_ * time; }
  /// Returns whether there is also time for a copy to advance by `time` [s].
  bool can_look_ahead(double time) const;

 private:
  double cost_ = 0.0;  ///< time to simulate one second, smoothed [s]
  bool behind_ = false;
};

/// Says when to show what is ahead of the committed simulation although there is more to commit: once in `period`, but
/// no more than half of the time is spent on it. A look ahead is the longer, the further behind the committed
/// simulation is; so this catches up.
class ShowTimes {
 public:
  explicit ShowTimes(double period) : period_(period) {}
  bool due(double now) const { return now >= next_; }
  /// Reports that what is shown was made from `began` to `ended` [s].
  void shown(double began, double ended) { next_ = ended + std::max(period_, ended - began); }

 private:
  double period_;      ///< [s]
  double next_ = 0.0;  ///< [s]
};

}  // namespace spring_workbench::live
