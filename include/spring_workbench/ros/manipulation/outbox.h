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

/// Takes states from the physics loop, and has a thread of its own make and send their messages: the loop does not wait
/// for them, unless a thousand states are unsent. Every committed state is sent, in order; of the displayed ones, the
/// newest. What has not changed is sent again ten times a second.
class Outbox {
 public:
  /// `publisher` and `runner` must outlive it, and nobody else may use `publisher`.
  Outbox(StatePublisher& publisher, live::SimulationRunner& runner);
  /// Sends what waits, and stops.
  ~Outbox();
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;

  /// Takes the displayed state, if it is due; the loop's thread. `local_time` [s]: now. See SimulationRunner::show().
  void take_shown(double latency, const hand_input::LocalTime& now);
  /// Takes the committed state, if it is due; the loop's thread. `report`: of the cycle that led to it; `deadline` [s]:
  /// of this cycle, in local time. Returns whether it was. Nothing is due between the first sample and the simulation's
  /// first step to it.
  bool take_committed(const live::CycleReport& report, double deadline);

  /// Cycles so far whose messages were sent after their deadline.
  std::size_t deadlines_missed() const { return deadlines_missed_; }
  /// How often the loop has waited because too many states were unsent.
  std::size_t waits();

 private:
  /// Whether something has to be sent again, or for the first time.
  struct Repeat {
    ros::Time stamp;
    std::size_t revision = 0;
    double sent = -1.0;  ///< [s], by the steady clock
    bool due(const live::Moment& moment);
  };
  void run();

  StatePublisher& publisher_;
  live::SimulationRunner& runner_;
  Repeat shown_due_, committed_due_;
  std::mutex mutex_;
  std::condition_variable bell_;
  std::optional<ShownState> shown_;          ///< not sent yet
  live::Backlog<CommittedState> committed_;  ///< not sent yet
  std::atomic<std::size_t> deadlines_missed_{0};
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace spring_workbench::manipulation
