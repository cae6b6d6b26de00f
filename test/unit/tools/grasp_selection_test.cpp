#include "spring_workbench/tools/grasp_selection.h"

#include <gtest/gtest.h>

namespace spring_workbench::tools {
namespace {

TEST(GraspSelection, PressingInsideGraspsAndLettingGoReleases) {
  GraspSelection hand;
  hand.set_inserted(3);
  EXPECT_EQ(hand.set_button(true, false), GraspEvent::grasp);
  EXPECT_EQ(hand.set_button(true, true), GraspEvent::none);
  EXPECT_EQ(hand.set_button(false, true), GraspEvent::release);
  EXPECT_EQ(hand.set_button(false, false), GraspEvent::none);
}

TEST(GraspSelection, PressingInTheAirGraspsNothingLater) {
  GraspSelection hand;
  EXPECT_EQ(hand.set_button(true, false), GraspEvent::none);
  hand.set_inserted(1);
  EXPECT_EQ(hand.set_button(true, false), GraspEvent::none);
  hand.set_button(false, false);
  EXPECT_EQ(hand.set_button(true, false), GraspEvent::grasp);
}

}  // namespace
}  // namespace spring_workbench::tools
