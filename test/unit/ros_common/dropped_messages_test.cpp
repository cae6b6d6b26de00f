#include "spring_workbench/ros/common/dropped_messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <random>

namespace spring_workbench::ros_common::dropped_messages_test {
namespace {

constexpr std::size_t queue_size = 5;

/// A connection as roscpp and the system treat it: messages go from the queue to the system's buffer.
class Sender {
 public:
  explicit Sender(std::size_t buffer) : buffer_(buffer) {}

  void send(std::size_t size) {
    if (queue_.size() == queue_size) {
      queue_.pop_front();
      ++dropped;
    }
    queue_.push_back(size);
    ++messages_;
    bytes_ += size;
    write();
  }
  void read(std::size_t bytes) {
    buffered_ -= std::min(bytes, buffered_);
    write();
  }
  ConnectionFigures figures() const {
    return {static_cast<std::uint32_t>(messages_), static_cast<std::uint32_t>(bytes_), written_, buffered_ == buffer_};
  }

  int dropped = 0;

 private:
  void write() {
    while (buffered_ < buffer_ && (rest_ > 0 || !queue_.empty())) {
      if (rest_ == 0) {
        rest_ = queue_.front();
        queue_.pop_front();
      }
      const std::size_t part = std::min(rest_, buffer_ - buffered_);
      rest_ -= part;
      buffered_ += part;
      written_ += static_cast<std::int64_t>(part);
    }
  }

  std::deque<std::size_t> queue_;
  std::size_t buffer_, buffered_ = 0, rest_ = 0;  ///< rest: of the message that is being written
  std::uint64_t messages_ = 0, bytes_ = 0;
  std::int64_t written_ = 0;
};

TEST(DroppedMessages, AreNoMoreThanThoseOfAReaderThatPausesAndAllOnceItReads) {
  Sender sender(10000);
  DroppedMessages counter(queue_size);
  double count = counter.observe(sender.figures());
  for (int second = 0; second < 100; ++second) {
    const bool reads = second % 10 < 3;
    for (int k = 0; k < 20; ++k) {
      sender.send(300);
      if (reads) sender.read(100000);
    }
    count += counter.observe(sender.figures());
    EXPECT_LT(count, sender.dropped + 0.5);
    const int phase = second % 10;
    if (phase > 7) {  // the last two seconds are not counted yet
      EXPECT_GT(count, sender.dropped - 2 * 20) << second;
    }
    if (phase == 2) {
      EXPECT_NEAR(count, sender.dropped, 0.5) << second;
    }
  }
  EXPECT_GT(sender.dropped, 1000);
}

TEST(DroppedMessages, AreNoneAsLongAsTheQueueIsNotFullWhateverTheSizes) {
  std::mt19937 random(1);
  Sender sender(10000);
  DroppedMessages counter(queue_size);
  for (int second = 0; second < 1000; ++second) {
    const int waiting = static_cast<int>(random() % queue_size);
    for (int k = 0; k < waiting; ++k) sender.send(random() % 10 == 0 ? 40000 : 40);
    EXPECT_EQ(counter.observe(sender.figures()), 0.0);
    for (int k = 0; k < 30; ++k) sender.read(10000);
    if (second % 2 == 0) {
      EXPECT_EQ(counter.observe(sender.figures()), 0.0);
    }
  }
  EXPECT_EQ(sender.dropped, 0);
}

TEST(DroppedMessages, AreCountedBeyondTheRangeOfTheFigures) {
  Sender sender(1u << 22);
  DroppedMessages counter(queue_size);
  double count = counter.observe(sender.figures());
  for (int second = 0; second < 20; ++second) {
    for (int k = 0; k < 10; ++k) sender.send(1u << 26);  // 2^26 bytes each: together 3 times the range
    count += counter.observe(sender.figures());
  }
  for (int k = 0; k < 1000; ++k) sender.read(1u << 22);
  for (int second = 0; second < 2; ++second) count += counter.observe(sender.figures());
  EXPECT_NEAR(count, sender.dropped, 0.5);
  EXPECT_GT(sender.dropped, 150);
}

}  // namespace
}  // namespace spring_workbench::ros_common::dropped_messages_test
