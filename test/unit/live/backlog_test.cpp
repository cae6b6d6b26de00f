#include "spring_workbench/live/backlog.h"

#include <gtest/gtest.h>

#include <future>
#include <numeric>

namespace spring_workbench::live::backlog_test {
namespace {

/// A producer that is faster than the consumer waits each time the backlog is full; nothing is lost or reordered.
TEST(Backlog, HoldsNoMoreThanItMayAndCountsTheWaits) {
  constexpr std::size_t rounds = 4;
  for (const std::size_t most : {std::size_t{1}, std::size_t{3}, std::size_t{1000}}) {
    std::mutex mutex;
    Backlog<std::size_t> backlog(most);
    std::future<void> made = std::async(std::launch::async, [&] {
      for (std::size_t i = 0; i < rounds * most; ++i) {
        std::unique_lock<std::mutex> lock(mutex);
        backlog.put(i, lock);
      }
    });
    std::vector<std::size_t> all;
    const auto take = [&] {
      const std::vector<std::size_t> taken = backlog.take();
      EXPECT_EQ(taken.size(), most);
      EXPECT_TRUE(backlog.empty());
      all.insert(all.end(), taken.begin(), taken.end());
    };
    for (std::size_t round = 1; round < rounds;) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (backlog.waits() < round) continue;
      take();
      ++round;
    }
    made.wait();
    take();
    EXPECT_EQ(backlog.waits(), rounds - 1);
    std::vector<std::size_t> expected(rounds * most);
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(all, expected);
  }
}

}  // namespace
}  // namespace spring_workbench::live::backlog_test
