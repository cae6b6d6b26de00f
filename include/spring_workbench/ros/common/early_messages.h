#pragma once

#include <cstddef>
#include <deque>
#include <utility>

#include "spring_workbench/ros/common/simulated_clock.h"

namespace spring_workbench::ros_common {

/// Holds the messages of one stream whose stamps are earlier than its newest one, until the clock or the other stream
/// jumps back as well.
template <typename Message>
class EarlyMessages {
 public:
  /// `capacity`: maximum number kept; older ones are dropped.
  explicit EarlyMessages(std::size_t capacity) : capacity_(capacity) {}

  void keep(const Message& message) {
    kept_.push_back(message);
    if (kept_.size() > capacity_) kept_.pop_front();
  }
  bool empty() const { return kept_.empty(); }
  void clear() { kept_.clear(); }
  /// Removes all; returns those that arrived after the last jump back of time.
  std::deque<Message> take() {
    std::deque<Message> kept = std::exchange(kept_, {});
    for (std::size_t i = kept.size(); i-- > 1;) {
      if ((kept[i - 1].header.stamp - kept[i].header.stamp).toSec() <= SimulatedClock::slip) continue;
      kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
    return kept;
  }

 private:
  std::size_t capacity_;
  std::deque<Message> kept_;
};

}  // namespace spring_workbench::ros_common
