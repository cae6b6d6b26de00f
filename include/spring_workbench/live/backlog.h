#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace spring_workbench::live {

/// Bounded queue from one thread to another, first in, first out. The producer waits while `capacity` items are unread.
/// Both threads lock the same mutex around each call.
template <typename T>
class Backlog {
 public:
  explicit Backlog(std::size_t capacity) : capacity_(capacity) {}
  /// Appends an item. Waits with the lock released until there is room.
  void put(T one, std::unique_lock<std::mutex>& lock) {
    if (kept_.size() >= capacity_) ++waits_;
    taken_.wait(lock, [this] { return kept_.size() < capacity_; });
    kept_.push_back(std::move(one));
  }
  /// Removes and returns all items.
  std::vector<T> take() {
    taken_.notify_one();
    return std::exchange(kept_, {});
  }
  bool empty() const { return kept_.empty(); }
  /// Number of times that put() had to wait.
  std::size_t waits() const { return waits_; }

 private:
  std::size_t capacity_, waits_ = 0;
  std::condition_variable taken_;
  std::vector<T> kept_;
};

}  // namespace spring_workbench::live
