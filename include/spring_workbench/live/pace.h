#pragma once

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

}  // namespace spring_workbench::live
