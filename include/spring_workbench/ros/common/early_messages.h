#pragma once

#include <cstddef>
#include <deque>
#include <utility>

#include "spring_workbench/ros/common/simulated_clock.h"

namespace spring_workbench::ros_common {

/// The messages of one stream that are stamped before its newest one: they wait for the clock, or for the other stream,
/// to jump back.
template <typename Message>
class EarlyMessages {
 public:
  /// `most`: how many are kept, the newest ones.
  explicit EarlyMessages(std::size_t most) : most_(most) {}

  void keep(const Message& message) {
    kept_.push_back(message);
    if (kept_.size() > most_) kept_.pop_front();
  }
  bool empty() const { return kept_.empty(); }
  void clear() { kept_.clear(); }
  /// Takes all; returns those that came after time went back for the last time.
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
  std::size_t most_;
  std::deque<Message> kept_;
};

}  // namespace spring_workbench::ros_common
