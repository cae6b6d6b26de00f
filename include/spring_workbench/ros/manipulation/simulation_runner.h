#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "spring_workbench/assembly/task_monitor.h"
#include "spring_workbench/hand_input/playout_clock.h"
#include "spring_workbench/hand_input/reacquisition.h"
#include "spring_workbench/ros/manipulation/stylus_input.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::manipulation {

/// What one cycle of the physics loop did.
struct CycleReport {
  simulation::AdvanceReport advance;
  double wall_time = 0.0;  ///< [s], by the steady clock
  bool leapt = false;      ///< time leapt and the simulation was started anew
  bool more = false;       ///< the samples allow to go on at once: call `cycle` again
};

/// What came of each stylus since the last cycle.
using HandEvents = std::array<std::vector<StylusEvent>, simulation::Simulation::most_hands>;

/// The simulation with the lock that keeps physics, services and publishers apart, fed with the styluses' events. Times
/// count from the epoch of the stylus that came first; another one joins it.
class SimulationRunner {
 public:
  /// `grid` [s]: 0, or in simulated time the step by which time goes on from the epoch's zero: each call of `cycle`
  /// then goes to the next multiple of it at most, whenever it is called. Throws InputError when scene and settings do
  /// not fit.
  SimulationRunner(const scene::Scene& scene, const simulation::SimulationSettings& settings,
                   const hand_input::TruthSettings& truth, double grid);

  /// Feeds the events, then simulates as far as the tracker's samples allow at local time `now`. In simulated time what
  /// the samples before a new epoch decide is simulated first, and the epoch waits for the next call.
  CycleReport cycle(const HandEvents& events, const hand_input::LocalTime& now);

  /// Objects back to their start, nothing held; goes on with the next sample.
  void restart();
  /// Another scene, with the settings as they are now. Throws InputError, and keeps the old one, when it does not fit.
  void load(const scene::Scene& scene);
  /// The same, and `prepare` changes the simulation first; then these objects are where they are said to be, and there
  /// when the first hand comes: see Simulation::place. Where anything throws, all stays as it was.
  void resume(const scene::Scene& scene, const std::function<void(simulation::Simulation&)>& prepare,
              const std::map<std::string, RigidTransform>& X_WO);

  /// Calls `use(Simulation&)` while nobody else does.
  template <typename Use>
  auto locked(Use&& use) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return use(*simulation_);
  }
  /// The assembly so far.
  assembly::TaskMonitor task() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return task_;
  }
  /// Stamp of the simulated time; `now` before the first sample.
  ros::Time stamp(const ros::Time& now) const;
  hand_input::ReengagementCounts hand_counts(std::size_t hand) const;

 private:
  struct HandInput {
    explicit HandInput(std::size_t number, const hand_input::TruthSettings& truth, double dropout_after,
                       bool simulated_time)
        : hand(number), playout(dropout_after, simulated_time), reengagement(truth) {}
    std::size_t hand;
    hand_input::PlayoutClock playout;
    hand_input::Reengagement reengagement;
    std::deque<StylusEvent> waiting;  ///< not fed yet
    double shift = 0.0;               ///< from its times to the simulation's [s]
    bool has_sample = false;          ///< since the last start
    bool in_epoch = false;            ///< its times are those of the present epoch
  };
  void apply(HandInput& input, const NewEpoch& epoch);
  void apply(HandInput& input, const StylusPose& pose);
  void apply(HandInput& input, const StylusButton& button);
  void apply(HandInput& input, const NextTool& press);
  void apply(HandInput& input, const ButtonsKnown& known);
  bool joins(const HandInput& input, const NewEpoch& epoch) const;
  double target(const hand_input::LocalTime& now) const;
  struct Loss {
    double t;
    std::size_t hand;
  };
  /// A hand that is lost up to `target` [s] and lets go.
  std::optional<Loss> take_release(double target);
  void feed(const hand_input::LocalTime& now);
  bool has_more(double target) const;
  double next_on_grid() const;
  void advance(double target, CycleReport& report);
  void start_anew();
  void forget_hands();

  mutable std::mutex mutex_;
  std::unique_ptr<simulation::Simulation> simulation_;
  assembly::TaskMonitor task_;
  std::vector<HandInput> inputs_;
  double grid_;                                   ///< [s]; 0: none
  ros::Time zero_;                                ///< of the simulation's times
  bool has_sample_ = false;                       ///< of any hand since the last start
  std::map<std::string, RigidTransform> places_;  ///< of objects, for the first epoch
};

}  // namespace spring_workbench::manipulation
