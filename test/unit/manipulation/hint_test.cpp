#include <gtest/gtest.h>

#include <string>

#include "spring_workbench/ros/manipulation/diagnostics.h"

namespace spring_workbench::manipulation::hint_test {
namespace {

/// Possible causes, and words that the hint must contain.
TEST(HintForSilence, NamesWhatToLookAt) {
  TrackerInput tracker;
  InputStatistics& input = tracker.input;
  const auto hint = [&](const std::vector<std::string>& senders = {}) {
    return hint_for_silence(tracker, senders, "stylus");
  };
  const auto expect = [](const std::string& text, const std::string& word) {
    EXPECT_NE(text.find(word), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  };
  expect(hint(), "is tracker_driver, or a bag, running?");
  expect(hint({"/driver"}), "/driver should send /tf");
  expect(hint({"/driver"}), "ROS_IP");
  expect(hint({"/driver"}), "is the device on?");
  input.messages = 100;
  input.frames = {"wand"};
  expect(hint(), "no frame stylus on /tf, but wand");
  input.frames.insert("stylus");
  EXPECT_EQ(hint(), "");  // the first ones are on their way
  for (const char* reason : {"too old", "from the future"}) {
    input.rejected = {{reason, 90}, {"too fast", 10}};
    input.newest_offer_age = 37.0;
    expect(hint(), reason);
    expect(hint(), "by 37 s: do the clocks of two hosts differ");
  }
  input.rejected = {{"not finite", 90}, {"too old", 10}};
  expect(hint(), "most often as: not finite");
  tracker.hand.stream.samples = 1;
  EXPECT_EQ(hint(), "");
}

}  // namespace
}  // namespace spring_workbench::manipulation::hint_test
