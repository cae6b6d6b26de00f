#include "spring_workbench/motion/stream_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace spring_workbench::motion::stream_clock_test {
namespace {

constexpr std::int64_t begin = 1'700'000'000'000'000'000;
constexpr std::int64_t ms = 1'000'000;

std::int64_t nanoseconds(double s) { return std::llround(1e9 * s); }

/// A sender at 125 Hz, whose messages arrive 1 to 4 ms late, and this host, with clocks that can be set.
struct Line {
  WallClock here;
  StreamClock clock{1.0};
  std::mt19937 random{7};
  std::int64_t steady = 5 * ms, here_set = 0, sender_set = 0;
  std::vector<StampResult> results;
  std::vector<std::int64_t> times;  ///< local ones of those that fit, less their true one

  WallMoment now() { return here.read(begin + steady + here_set, steady); }
  void judge(std::int64_t stamp, const WallMoment& at, std::int64_t sent) {
    const StampResult result = clock.check(stamp, at);
    if (result == StampResult::fits) times.push_back(clock.local(stamp) - begin - sent);
  }
  /// Sends a message that arrives `late` [ns] after it was stamped.
  StampResult send(std::int64_t late, std::int64_t ahead = 0) {
    const std::int64_t stamp = begin + steady - late + sender_set + ahead;
    const StampResult result = clock.check(stamp, now());
    results.push_back(result);
    if (result == StampResult::stepped) judge(stamp, now(), steady - late);
    if (result == StampResult::fits) times.push_back(clock.local(stamp) - begin - (steady - late));
    return result;
  }
  void run(int messages) {
    for (int k = 0; k < messages; ++k) {
      steady += 8 * ms;
      send(ms + static_cast<std::int64_t>(random() % (3 * ms)));
    }
  }
};

const double steps[] = {0.3, -0.3, 3.0, -3.0, 3600.0, -3600.0};

TEST(StreamClock, AStepOfBothClocksIsTakenOutToTheBit) {
  for (const double by : steps) {
    Line line;
    line.run(100);
    line.here_set = line.sender_set = nanoseconds(by);
    line.run(100);
    ASSERT_EQ(line.times.size(), 200u) << by;
    for (const std::int64_t error : line.times) EXPECT_EQ(error, 0);
    EXPECT_EQ(line.clock.steps(), 1u);
    EXPECT_EQ(line.now().steps, nanoseconds(by));
    EXPECT_EQ(line.clock.take_host_steps(), 0.0);
  }
}

/// Both clocks are set while messages are under way, which still have stamps of the old time: one step.
TEST(StreamClock, MessagesUnderWayWhenBothClocksAreSetFitAndReportNothing) {
  for (const double by : steps) {
    Line line;
    line.run(100);
    line.here_set = nanoseconds(by);
    for (int k = 1; k <= 3; ++k) {
      line.steady += ms;
      EXPECT_EQ(line.send(k * ms + ms / 2), StampResult::fits) << by;  // stamped half a millisecond before the step
    }
    line.sender_set = nanoseconds(by);
    line.run(100);
    ASSERT_EQ(line.times.size(), 203u) << by;
    for (const std::int64_t error : line.times) EXPECT_EQ(error, 0);
    EXPECT_EQ(line.clock.steps(), 1u);
    EXPECT_EQ(line.clock.take_host_steps(), 0.0);
  }
}

TEST(StreamClock, AStepOfThisHostAloneIsNotSeenInTheStream) {
  for (const double by : steps) {
    Line line;
    line.run(100);
    line.here_set = nanoseconds(by);
    line.run(100);
    EXPECT_EQ(line.times.size(), 200u);
    EXPECT_EQ(line.clock.steps(), 0u) << by;
    for (const std::int64_t error : line.times) EXPECT_EQ(error, 0);
    EXPECT_NEAR(line.clock.take_host_steps(), by, 1e-9 * std::abs(by));
    EXPECT_EQ(line.clock.take_host_steps(), 0.0);
  }
}

/// Detected from the arrival of the messages, up to the variation of their latency.
TEST(StreamClock, AStepOfTheSenderAloneIsFoundWithinAFewMessages) {
  for (const double by : steps) {
    Line line;
    line.run(100);
    line.sender_set = nanoseconds(by);
    line.run(100);
    EXPECT_EQ(line.clock.steps(), 1u) << by;
    EXPECT_GE(line.times.size(), 190u);
    for (const std::int64_t error : line.times) EXPECT_LT(std::abs(error), 4 * ms) << by;
    EXPECT_EQ(line.clock.take_host_steps(), 0.0);
  }
}

TEST(StreamClock, ASingleMessageDoesNotMoveTheClock) {
  for (const double ahead : {0.9, -0.5, 5.0, -50.0, 0.2}) {
    Line line;
    line.run(50);
    EXPECT_NE(line.send(0, nanoseconds(ahead)), StampResult::fits) << ahead;
    EXPECT_NE(line.send(0, nanoseconds(ahead)), StampResult::stepped);
    line.run(50);
    EXPECT_EQ(line.times.size(), 100u);
    EXPECT_EQ(line.clock.steps(), 0u);
  }
}

/// Seven seconds in which this process was stopped: all messages arrive at once.
TEST(StreamClock, QueuedMessagesAreNoStep) {
  Line line;
  line.run(50);
  line.steady += 7000 * ms;
  for (int k = 875; k > 0; --k) {
    line.steady += ms / 100;
    line.send(k * 8 * ms);
  }
  line.run(50);
  EXPECT_EQ(line.clock.steps(), 0u);
  EXPECT_EQ(line.times.size(), 100u + 125u);  // those of the last second, and no older
  for (const std::int64_t error : line.times) EXPECT_EQ(error, 0);
}

/// The steady clock does not count it; both wall clocks do.
TEST(StreamClock, ASuspendedMachineIsAStepOfBoth) {
  Line line;
  line.run(50);
  line.here_set = line.sender_set = nanoseconds(60.0);
  line.run(50);
  for (const std::int64_t error : line.times) EXPECT_EQ(error, 0);
  EXPECT_EQ(line.times.size(), 100u);
  EXPECT_EQ(line.clock.steps(), 1u);
  EXPECT_EQ(line.clock.take_host_steps(), 0.0);
}

TEST(StreamClock, DriftIsFollowed) {
  for (const double rate : {5e-4, -5e-4}) {
    Line line;
    line.run(50);
    for (int k = 0; k < 100'000; ++k) {
      line.sender_set = nanoseconds(rate * 0.008 * k);
      line.run(1);
    }
    EXPECT_EQ(line.times.size(), 100'050u);
    EXPECT_EQ(line.clock.steps(), 0u);
  }
}

TEST(StreamClock, AStreamBeginsNearNow) {
  for (const double off : {1.5, -1.5, 1e6, -1e6}) {
    Line line;
    line.sender_set = nanoseconds(off);
    for (int k = 0; k < 100; ++k) {
      line.steady += 8 * ms;
      EXPECT_EQ(line.send(ms), off > 0.0 ? StampResult::from_the_future : StampResult::too_old);
    }
  }
  Line late;  // it begins after this host's clock was set
  late.now();
  late.here_set = late.sender_set = nanoseconds(-3600.0);
  late.run(10);
  EXPECT_EQ(late.times.size(), 10u);
  for (const std::int64_t error : late.times) EXPECT_EQ(error, 0);
}

/// Each names the rule that was broken, and no other.
TEST(StreamClock, SaysWhatIsWrongWithAStamp) {
  EXPECT_EQ(complaint(StampResult::too_old, 1.7, 1.0).rfind("stamp: 1.7 s old, more than max_age = 1 s (", 0), 0u);
  EXPECT_EQ(complaint(StampResult::from_the_future, -50.0, 1.0).rfind("stamp: 50 s ahead of now, more than max_age", 0),
            0u);
  EXPECT_EQ(complaint(StampResult::from_the_future, -0.9, 1.0).rfind("stamp: ahead of the others of its stream", 0),
            0u);
  EXPECT_EQ(complaint(StampResult::not_later, 0.9, 1.0).rfind("stamp: before the newest of its stream by more", 0), 0u);
}

}  // namespace
}  // namespace spring_workbench::motion::stream_clock_test
