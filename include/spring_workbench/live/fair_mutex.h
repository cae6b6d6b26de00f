#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace spring_workbench::live {

/// Mutex that threads get in the order in which they ask for it: a thread that locks it again and again makes no other
/// thread wait for more than one turn.
class FairMutex {
 public:
  void lock() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::size_t turn = asked_++;
    next_.wait(lock, [&] { return turn == turn_; });
  }
  void unlock() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++turn_;
    }
    next_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable next_;
  std::size_t asked_ = 0, turn_ = 0;
};

}  // namespace spring_workbench::live
