#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace spring_workbench::live {

/// Mutex that is granted in the order of requests (a ticket lock), so a thread that locks it repeatedly cannot starve
/// the others.
class FairMutex {
 public:
  void lock() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::size_t ticket = next_ticket_++;
    next_.wait(lock, [&] { return ticket == now_serving_; });
  }
  void unlock() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++now_serving_;
    }
    next_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable next_;
  std::size_t next_ticket_ = 0, now_serving_ = 0;
};

}  // namespace spring_workbench::live
