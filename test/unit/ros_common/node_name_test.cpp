#include "spring_workbench/ros/common/node_name.h"

#include <gtest/gtest.h>

#include <string>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::ros_common::node_name_test {
namespace {

TEST(NodeName, NamesOfANodeAndOfItsNamespace) {
  EXPECT_EQ(NodeName("manipulation").of_node("fork"), "manipulation/fork");
  EXPECT_EQ(NodeName("manipulation").in_namespace("stylus/joy"), "/stylus/joy");
  EXPECT_EQ(NodeName("left/manipulation").in_namespace("stylus/joy"), "/left/stylus/joy");
  EXPECT_EQ(NodeName("/lab/right/bench").of_node("fork"), "/lab/right/bench/fork");
  EXPECT_EQ(NodeName("/lab/right/bench").in_namespace("tracker_driver/grasp"), "/lab/right/tracker_driver/grasp");
}

TEST(NodeName, WhatNoNodeCanBeCalledIsRefused) {
  for (const std::string name : {"", "/", "left/", "~node", "two words", "1st", "bench?", "a\nb"}) {
    EXPECT_THROW(NodeName{name}, validation::InputError) << name;
  }
}

}  // namespace
}  // namespace spring_workbench::ros_common::node_name_test
