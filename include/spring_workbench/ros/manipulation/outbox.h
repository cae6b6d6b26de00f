#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <thread>

#include "spring_workbench/live/backlog.h"
#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/ros/manipulation/state_publisher.h"

namespace spring_workbench::manipulation {

/// Builds and publishes the messages of the physics loop's states in a separate thread, so that the loop waits only if
/// a thousand states are unsent. Every committed state is sent, in order; of the displayed states only the newest. An
/// unchanged state is repeated ten times a second.
class Outbox {
 public:
  /// `publisher` and `runner` must outlive this object, and nothing else may use `publisher`.
  Outbox(StatePublisher& publisher, live::SimulationRunner& runner);
  /// Sends the waiting states and stops the thread.
  ~Outbox();
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;

  /// Takes the displayed state, if it is due. To be called from the loop's thread; see SimulationRunner::show().
  void take_shown(double latency, const hand_input::LocalTime& now);
  /// Takes the committed state, if it is due, and returns whether it was. To be called from the loop's thread.
  /// `report`: of the cycle that led to it; `deadline`: of this cycle, in local time [s]. Nothing is due between the
  /// first sample and the first step of the simulation, nor while the steps to a sample or button edge are interrupted.
  bool take_committed(const live::CycleReport& report, double deadline);

  /// Number of cycles whose messages were sent after the deadline.
  std::size_t deadlines_missed() const { return deadlines_missed_; }
  /// Number of times that the loop had to wait because too many states were unsent.
  std::size_t waits();

 private:
  /// Decides whether a state has to be sent, for the first time or again.
  struct Repeat {
    ros::Time stamp;
    std::size_t revision = 0;
    double sent = -1.0;  ///< [s], by the steady clock
    bool due(const live::Progress& progress);
  };
  void run();

  StatePublisher& publisher_;
  live::SimulationRunner& runner_;
  Repeat shown_due_, committed_due_;
  std::mutex mutex_;
  std::condition_variable condition_;
  std::optional<ShownState> shown_;          ///< not sent yet
  live::Backlog<CommittedState> committed_;  ///< not sent yet
  std::atomic<std::size_t> deadlines_missed_{0};
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace spring_workbench::manipulation
