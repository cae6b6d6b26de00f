#include "spring_workbench/ros/manipulation/outbox.h"

#include <chrono>
#include <utility>
#include <vector>

#include "constants.h"
#include "spring_workbench/ros/common/loop_clock.h"

namespace spring_workbench::manipulation {

Outbox::Outbox(StatePublisher& publisher, live::SimulationRunner& runner)
    : publisher_(publisher), runner_(runner), committed_(state_queue), thread_([this] { run(); }) {}

Outbox::~Outbox() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  condition_.notify_one();
  thread_.join();
}

bool Outbox::Repeat::due(const live::Progress& progress) {
  const ros::Time new_stamp = ros_common::stamp_of(progress.began ? std::make_optional(progress.stamp) : std::nullopt);
  const double steady = ros_common::steady_time();
  // Before the first sample the stamp advances by itself.
  const bool same = progress.revision == revision && (new_stamp == stamp || !progress.began);
  if (same && steady < sent + repeat_after) return false;
  *this = {new_stamp, progress.revision, steady};
  return true;
}

void Outbox::take_shown(double latency, const hand_input::LocalTime& now) {
  std::optional<live::Shown> shown =
      runner_.show(latency, now, [this](const live::Progress& progress) { return shown_due_.due(progress); });
  if (!shown) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    shown_ = ShownState{std::move(*shown), shown_due_.stamp, now.loop};
  }
  condition_.notify_one();
}

bool Outbox::take_committed(const live::CycleReport& report, double deadline) {
  std::optional<live::Committed> committed = runner_.committed([this](const live::Progress& progress) {
    return (progress.began || !progress.has_sample) && !progress.is_interrupted && committed_due_.due(progress);
  });
  if (!committed) return false;
  std::unique_lock<std::mutex> lock(mutex_);
  committed_.put({std::move(*committed), committed_due_.stamp, report, deadline}, lock);
  lock.unlock();
  condition_.notify_one();
  return true;
}

std::size_t Outbox::waits() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return committed_.waits();
}

/// The journal does not wake this thread; it is published whenever a state is sent, and at least as often as a state is
/// repeated.
void Outbox::run() {
  double publish_time = 0.0;
  std::unique_lock<std::mutex> lock(mutex_);
  for (bool stop = false; !stop;) {
    condition_.wait_for(lock, std::chrono::duration<double>(repeat_after),
                        [this] { return stop_ || shown_ || !committed_.empty(); });
    stop = stop_;
    std::optional<ShownState> shown = std::exchange(shown_, std::nullopt);
    const std::vector<CommittedState> committed = committed_.take();
    lock.unlock();
    const double begin = ros_common::steady_time();
    if (shown) publisher_.publish(std::move(*shown));
    for (const CommittedState& state : committed) {
      publisher_.publish(state, publish_time);
      if (ros_common::loop_time() > state.deadline) ++deadlines_missed_;
    }
    publisher_.publish_journal(runner_);
    publish_time = ros_common::steady_time() - begin;
    lock.lock();
  }
}

}  // namespace spring_workbench::manipulation
