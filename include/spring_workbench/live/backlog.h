#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace spring_workbench::live {

/// What one thread has made and another one has not taken yet, in order, and no more than `most`: beyond that, the
/// maker waits. Both threads lock the same mutex around each call.
template <typename T>
class Backlog {
 public:
  explicit Backlog(std::size_t most) : most_(most) {}
  /// Waits until there is room, without the lock.
  void put(T one, std::unique_lock<std::mutex>& lock) {
    if (kept_.size() >= most_) ++waits_;
    taken_.wait(lock, [this] { return kept_.size() < most_; });
    kept_.push_back(std::move(one));
  }
  /// Returns all.
  std::vector<T> take() {
    taken_.notify_one();
    return std::exchange(kept_, {});
  }
  bool empty() const { return kept_.empty(); }
  /// How often put() had to wait.
  std::size_t waits() const { return waits_; }

 private:
  std::size_t most_, waits_ = 0;
  std::condition_variable taken_;
  std::vector<T> kept_;
};

}  // namespace spring_workbench::live
