#pragma once

#include <array>
#include <deque>
#include <map>
#include <mutex>
#include <vector>

#include "spring_workbench/assembly/task_monitor.h"
#include "spring_workbench/hand_input/feed.h"
#include "spring_workbench/motion/stream_monitor.h"
#include "spring_workbench/ros/manipulation/stylus_input.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::manipulation {

/// What one cycle of the physics loop did.
struct CycleReport {
  simulation::AdvanceReport advance;
  double wall_time = 0.0;  ///< [s], by the steady clock
  bool leapt = false;      ///< time leapt and the simulation was started anew
  bool more = false;       ///< the samples allow to go on at once: call `cycle` again
  std::array<std::vector<RejectedPose>, simulation::Simulation::most_hands> rejected;  ///< by the gate, of each hand
};

/// What became of one hand's samples so far.
struct HandStatistics {
  motion::StreamFigures stream;  ///< of the samples used
  hand_input::GateCounts gate;
  hand_input::ReacquisitionCounts reacquisition;
  double newest_arrival = 0.0;  ///< of a sample used, in local time [s]
};

/// What came of each stylus since the last cycle.
using HandEvents = std::array<std::vector<StylusEvent>, simulation::Simulation::most_hands>;

/// The simulation and its feed with the lock that keeps physics, services and publishers apart, and the epochs of ROS
/// time: times count from the epoch of the stylus that came first; another one joins it.
class SimulationRunner {
 public:
  /// `grid` [s]: 0, or in simulated time the step by which time goes on from the epoch's zero: each call of `cycle`
  /// then goes to the next multiple of it at most, whenever it is called. Throws InputError when scene and settings do
  /// not fit.
  SimulationRunner(const scene::Scene& scene, const simulation::SimulationSettings& settings,
                   const hand_input::InputSettings& input, double grid);

  /// Feeds the events, then simulates as far as the tracker's samples allow at local time `now`. In simulated time what
  /// the samples before a new epoch decide is simulated first, and the epoch waits for the next call.
  CycleReport cycle(const HandEvents& events, const hand_input::LocalTime& now);

  /// Objects back to their start, nothing held; goes on with the next sample.
  void restart();
  /// Another scene, with the settings as they are now. Throws InputError, and keeps the old one, when it does not fit.
  void load(const scene::Scene& scene);
  /// Another scene, with tools and settings as of a saved state and the objects where they are in it; nobody holds.
  /// They are there when the first hand comes, too, whose time begins anew. Throws InputError, and keeps all as it was,
  /// when the state does not fit the scene.
  void resume(const scene::Scene& scene, const simulation::SimulationState& state);

  /// Calls `use(Simulation&)` while nobody else does.
  template <typename Use>
  auto locked(Use&& use) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return use(simulation_);
  }
  /// The assembly so far.
  assembly::TaskMonitor task() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return task_;
  }
  /// Stamp of the simulated time; `now` before the first sample.
  ros::Time stamp(const ros::Time& now) const;
  HandStatistics hand_statistics(std::size_t hand) const;

 private:
  struct HandInput {
    HandInput(std::size_t number, double dropout_after) : hand(number), monitor(dropout_after) {}
    std::size_t hand;
    motion::StreamMonitor monitor;
    double newest_arrival = 0.0;         ///< see HandStatistics
    std::deque<StylusEvent> waiting;     ///< not fed yet
    std::vector<RejectedPose> rejected;  ///< not reported yet
    double shift = 0.0;                  ///< from its times to the simulation's [s]
    bool in_epoch = false;               ///< its times are those of the present epoch
  };
  void apply(HandInput& input, const NewEpoch& epoch);
  void apply(HandInput& input, const StylusPose& pose);
  void apply(HandInput& input, const StylusButton& button);
  void apply(HandInput& input, const NextTool& press);
  void apply(HandInput& input, const ButtonsKnown& known);
  bool joins(const HandInput& input, const NewEpoch& epoch) const;
  void feed(const hand_input::LocalTime& now);
  bool has_more(double target) const;
  double next_on_grid() const;
  void advance(double target, CycleReport& report);
  void start_anew();
  void begin_with(simulation::Simulation simulation);

  mutable std::mutex mutex_;
  simulation::Simulation simulation_;
  hand_input::Feed feed_;
  assembly::TaskMonitor task_;
  std::vector<HandInput> inputs_;
  double grid_;                                   ///< [s]; 0: none
  ros::Time zero_;                                ///< of the simulation's times
  std::map<std::string, RigidTransform> places_;  ///< of objects, for the first epoch
};

}  // namespace spring_workbench::manipulation
