#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "spring_workbench/ros_interface/playout_clock.h"
#include "spring_workbench/ros_interface/stylus_input.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/task/task_monitor.h"
#include "spring_workbench/tracker/reengagement.h"

namespace spring_workbench {

/// What one cycle of the physics loop did.
struct CycleReport {
  AdvanceReport advance;
  double wall_time = 0.0;  ///< [s], by the steady clock
  bool leapt = false;      ///< time leapt and the simulation was started anew
  bool more = false;       ///< the samples allow to go on at once: call `cycle` again
};

/// The simulation with the lock that keeps physics, services and publishers apart, fed with the stylus' events.
class SimulationRunner {
 public:
  /// `grid` [s]: 0, or in simulated time the step by which time goes on from the epoch's zero: each call of `cycle`
  /// then goes to the next multiple of it at most, whenever it is called. Throws InputError when scene and settings do
  /// not fit.
  SimulationRunner(const Scene& scene, const SimulationSettings& settings, const TruthSettings& truth, double grid);

  /// Feeds the events, then simulates as far as the tracker's samples allow at local time `now`. In simulated time what
  /// the samples before a new epoch decide is simulated first, and the epoch waits for the next call.
  CycleReport cycle(const std::vector<StylusEvent>& events, const LocalTime& now);

  /// Objects back to their start, nothing held; goes on with the next sample.
  void restart();
  /// Another scene, with the settings as they are now. Throws InputError, and keeps the old one, when it does not fit.
  void load(const Scene& scene);

  /// Calls `use(Simulation&)` while nobody else does.
  template <typename Use>
  auto locked(Use&& use) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return use(*simulation_);
  }
  /// The assembly so far.
  TaskMonitor task() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return task_;
  }
  /// Stamp of the simulated time; `now` before the first sample.
  ros::Time stamp(const ros::Time& now) const;
  ReengagementCounts hand_counts() const;

 private:
  void apply(const NewEpoch& epoch);
  void apply(const StylusPose& pose);
  void apply(const StylusButton& button);
  void apply(const ButtonsKnown& known);
  void feed(const LocalTime& now);
  bool has_more(double target) const;
  double next_on_grid() const;
  void advance(double target, CycleReport& report);
  void start_anew();

  mutable std::mutex mutex_;
  std::unique_ptr<Simulation> simulation_;
  TaskMonitor task_;
  PlayoutClock playout_;
  Reengagement hand_;
  double grid_;              ///< [s]; 0: none
  std::deque<StylusEvent> waiting_;  ///< not fed yet
  ros::Time zero_;           ///< of the stylus' times
  bool has_sample_ = false;  ///< since the last start
};

}  // namespace spring_workbench
