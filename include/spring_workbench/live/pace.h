#pragma once

#include <algorithm>
#include <functional>
#include <utility>

namespace spring_workbench::live {

/// Measures how much time the simulation takes and whether it keeps up with the hands. While it is behind, simulated
/// time runs slower than the hands' time, and no new sample is accepted until all accepted ones have been simulated.
class Pace {
 public:
  /// `clock`: measures the time of the work [s]; by default the steady clock.
  explicit Pace(std::function<double()> clock = steady_seconds) : clock_(std::move(clock)) {}
  static double steady_seconds();
  double now() const { return clock_(); }

  /// Reports a commit that simulated `simulated` [s] and took `took` [s] by that clock. `lag`: time from the
  /// committed time to the newest sample not simulated yet [s].
  void committed(double simulated, double took, double lag);
  /// Reports that all accepted samples have been simulated.
  void caught_up() { behind_ = false; }
  bool is_behind() const { return behind_; }
  /// Returns the time [s] that it takes to simulate `time` [s].
  double work(double time) const { return cost_ * time; }
  /// Returns whether there is enough time to advance a copy by `time` [s] as well; not after a change, until a commit.
  bool can_look_ahead(double time) const;
  /// Returns the time at which one cycle pauses on the way from `begin` (−infinity: nothing is committed) to `stop`
  /// [s]: after as many steps of `step` [s] as can be simulated in a tenth of a second; after one step if a change was
  /// made and nothing committed since. The next cycle continues.
  double end_of_cycle(double begin, double stop, double step) const;
  /// Reports a change, after which the costs are not known.
  void changed() { measured_ = false; }

 private:
  std::function<double()> clock_;
  bool measured_ = true;
  double cost_ = 0.0;  ///< time to simulate one second, smoothed [s]
  bool behind_ = false;
};

/// Schedules updates of the display while there is more to commit: once per `period`, but with at most half of the
/// time. An update takes the longer the further the committed simulation is behind, so this bound lets it catch up.
class ShowTimes {
 public:
  explicit ShowTimes(double period) : period_(period) {}
  bool due(double now) const { return now >= next_; }
  /// Reports that an update of the display was computed from `began` to `ended` [s].
  void shown(double began, double ended) { next_ = ended + std::max(period_, ended - began); }

 private:
  double period_;      ///< [s]
  double next_ = 0.0;  ///< [s]
};

}  // namespace spring_workbench::live
