// What a machine's force sensor measures, over time.
#include "spring_workbench/motion/external_wrench.h"

#include <gtest/gtest.h>

#include <limits>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::motion::external_wrench_test {
namespace {

constexpr double timeout = 0.1, same_time = 1e-9;
constexpr double never = std::numeric_limits<double>::infinity();

ExternalWrench sample(double t, double force) {
  return {t, {force * Vector3d::UnitX(), Vector3d::Zero()}, ExternalWrench::Axes::world};
}

math::StateArchive::Words words(WrenchTrack& track) {
  math::StateArchive archive;
  track.archive(archive);
  return archive.words();
}

TEST(WrenchTrack, EachSampleActsFromItsTimeToTheNext) {
  WrenchTrack track(timeout);
  EXPECT_EQ(track.next_change_time(0.0, same_time), never);
  track.push(sample(1.0, 3.0));
  track.push(sample(1.05, 4.0));
  EXPECT_EQ(track.next_change_time(0.0, same_time), 1.0);
  EXPECT_FALSE(track.advance_to(0.99, same_time));
  EXPECT_FALSE(track.present());
  EXPECT_FALSE(track.advance_to(1.0, same_time));
  EXPECT_EQ(track.present()->wrench.force.x(), 3.0);
  EXPECT_EQ(track.next_change_time(1.0, same_time), 1.05);
  EXPECT_FALSE(track.advance_to(1.07, same_time));
  EXPECT_EQ(track.present()->wrench.force.x(), 4.0);
}

TEST(WrenchTrack, TheWatchdogSetsItToZeroOnce) {
  WrenchTrack track(timeout);
  track.push(sample(1.0, 3.0));
  track.advance_to(1.0, same_time);
  EXPECT_EQ(track.next_change_time(1.0, same_time), 1.0 + timeout);
  EXPECT_FALSE(track.advance_to(1.0 + 0.999 * timeout, same_time));
  EXPECT_TRUE(track.present());
  EXPECT_TRUE(track.advance_to(1.0 + timeout, same_time));
  EXPECT_FALSE(track.present());
  EXPECT_FALSE(track.advance_to(1.0 + 2.0 * timeout, same_time));
  EXPECT_EQ(track.next_change_time(1.0 + 2.0 * timeout, same_time), never);
  track.push(sample(1.5, 5.0));  // and the next one acts again
  track.advance_to(1.5, same_time);
  EXPECT_EQ(track.present()->wrench.force.x(), 5.0);
}

TEST(WrenchTrack, OneThatComesTooLateActsAtOnceOrNotAtAll) {
  WrenchTrack track(timeout);
  track.push(sample(1.0, 3.0));
  EXPECT_FALSE(track.advance_to(1.0 + 0.5 * timeout, same_time));
  EXPECT_EQ(track.present()->wrench.force.x(), 3.0);
  track.push(sample(1.2, 4.0));
  EXPECT_TRUE(track.advance_to(1.2 + 2.0 * timeout, same_time));
  EXPECT_FALSE(track.present());
}

/// As after skipped time: later messages count.
TEST(WrenchTrack, ALaterMessageReplacesPendingOnesThatAreNotEarlier) {
  WrenchTrack track(timeout);
  for (const double t : {1.0, 2.0, 3.0}) track.push(sample(t, t));
  track.push(sample(1.5, 7.0));
  EXPECT_EQ(track.next_change_time(1.0, same_time), 1.5);
  track.advance_to(1.5, same_time);
  EXPECT_EQ(track.present()->wrench.force.x(), 7.0);
  EXPECT_EQ(track.next_change_time(1.5, same_time), 1.5 + timeout);
}

TEST(WrenchTrack, RefusesImplausibleWrenchesAndIsUnchanged) {
  WrenchTrack track(timeout);
  track.push(sample(1.0, 3.0));
  const math::StateArchive::Words before = words(track);
  const auto refused = [&](const ExternalWrench& bad, const std::string& field) {
    try {
      track.push(bad);
      ADD_FAILURE() << field << " was taken";
    } catch (const validation::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
    EXPECT_EQ(words(track), before);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, never, -never, 1.001e5, -1.001e5}) {
    ExternalWrench wrench = sample(2.0, 0.0);
    wrench.wrench.force.y() = bad;
    refused(wrench, "force.y: invalid value '");
    refused(wrench, "': expected a number between -100000 and 100000 N");
    wrench = sample(2.0, 0.0);
    wrench.wrench.moment.z() = bad;
    refused(wrench, "torque.z: invalid value '");
    refused(wrench, "': expected a number between -100000 and 100000 N·m");
  }
  for (const double bad : {nan, never, 2e12}) refused(sample(bad, 1.0), "t: ");
  ExternalWrench wrench = sample(2.0, 1.0);
  wrench.axes = static_cast<ExternalWrench::Axes>(2);
  refused(wrench, "axes: ");
  wrench = sample(2.0, 1e5);
  wrench.wrench.moment.x() = -1e5;
  track.push(wrench);
  EXPECT_NE(words(track), before);
}

}  // namespace
}  // namespace spring_workbench::motion::external_wrench_test
