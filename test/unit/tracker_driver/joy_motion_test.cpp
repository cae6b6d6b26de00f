#include "spring_workbench/ros/tracker_driver/joy_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::tracker_driver::joy_motion_test {
namespace {

const std::vector<float> still(6, 0.0F);

JoyMotion at_origin(const JoySettings& settings = {}) { return JoyMotion(settings, RigidTransform::Identity()); }

TEST(JoyMotion, FullDeflectionIsFullSpeedAlongAndAboutEachAxis) {
  const JoySettings settings;
  for (std::size_t i = 0; i < 6; ++i) {
    for (const float side : {1.0F, -1.0F}) {
      JoyMotion motion = at_origin();
      std::vector<float> axes = still;
      axes[i] = side;
      RigidTransform X = RigidTransform::Identity();
      for (int k = 0; k < 20; ++k) {
        motion.input(axes, {});
        X = motion.advance(0.01);
      }
      const Vector3d unit = static_cast<double>(side) * Vector3d::Unit(static_cast<Eigen::Index>(i % 3));
      const Vector3d moved = i < 3 ? Vector3d(0.2 * settings.move_speed * unit) : Vector3d::Zero();
      const Vector3d turned = i < 3 ? Vector3d::Zero() : Vector3d(0.2 * settings.turn_speed * unit);
      EXPECT_LT((X.translation() - moved).norm(), 1e-12);
      EXPECT_LT((math::log_so3(X.linear()) - turned).norm(), 1e-12);
    }
  }
}

TEST(JoyMotion, SpeedGrowsFromZeroAtTheEdgeOfTheDeadZoneAndIsOdd) {
  JoySettings settings;
  settings.dead_zone = 0.2;
  double last = 0.0;
  for (int k = 0; k <= 150; ++k) {
    const float value = 0.01F * static_cast<float>(k);
    std::vector<double> ways;
    for (const float side : {1.0F, -1.0F}) {
      JoyMotion motion = at_origin(settings);
      motion.input({side * value}, {});
      ways.push_back(motion.advance(0.1).translation().x());
    }
    EXPECT_DOUBLE_EQ(ways[0], -ways[1]);
    if (value <= 0.19F) {
      EXPECT_EQ(ways[0], 0.0);
    }
    if (value >= 1.0F) {
      EXPECT_DOUBLE_EQ(ways[0], 0.1 * settings.move_speed);
    }
    EXPECT_GE(ways[0], last);
    EXPECT_LE(ways[0] - last,
              0.1 * settings.move_speed * 0.0126);  // no jump: 0.01 of deflection over the 0.8 that count
    last = ways[0];
  }
}

TEST(JoyMotion, WhatIsNotThereOrNotFiniteMovesNothing) {
  JoySettings settings;
  settings.axes = {0, -1, 63, 1, 2, -1};
  JoyMotion motion = at_origin(settings);
  motion.input({std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0.0F}, {});
  EXPECT_TRUE(motion.advance(0.3).isApprox(RigidTransform::Identity(), 0.0));
  EXPECT_FALSE(motion.grasp());
}

TEST(JoyMotion, StandsStillWhenTheDeviceFallsSilent) {
  JoyMotion motion = at_origin();
  motion.input({1.0F}, {1, 1});
  double x = 0.0;
  for (int k = 0; k < 300; ++k) x = motion.advance(0.01).translation().x();
  EXPECT_NEAR(x, JoyMotion::timeout * JoySettings().move_speed, 0.011 * JoySettings().move_speed);
  EXPECT_TRUE(motion.grasp());  // what is held is not dropped
  motion.input({1.0F}, {});
  EXPECT_GT(motion.advance(0.01).translation().x(), x);
}

TEST(JoyMotion, DoesNotGoBeyondItsReach) {
  JoyMotion motion = at_origin();
  double x = 0.0;
  for (int k = 0; k < 2000; ++k) {
    motion.input({1.0F}, {});
    x = motion.advance(0.02).translation().x();
  }
  EXPECT_EQ(x, JoyMotion::reach);
}

TEST(JoyMotion, ButtonsAreDownWhileHeld) {
  JoySettings settings;
  settings.grasp_button = 2;
  settings.tool_button = 0;
  JoyMotion motion = at_origin(settings);
  motion.input(still, {0, 1, 1});
  EXPECT_TRUE(motion.grasp());
  EXPECT_FALSE(motion.next_tool());
  EXPECT_TRUE(motion.clutch());
  motion.input(still, {1, 1, 0});
  EXPECT_FALSE(motion.grasp());
  EXPECT_TRUE(motion.next_tool());
  EXPECT_FALSE(motion.clutch());
}

TEST(JoySettings, BadValuesAreRefusedByName) {
  const std::vector<std::string> bad{
      "axes: [0, 1]",     "axes: 3",         "axes: [0, 1, 2, 3, 4, 64]", "axes: [0, 1, 2, 3, 4, x]",
      "move_speed: -1",   "move_speed: 2.1", "turn_speed: .nan",          "dead_zone: 1",
      "grasp_button: -2", "tool_button: 1.5"};
  for (const std::string& text : bad) {
    try {
      read_joy_settings(YAML::Load("{" + text + "}"), "here");
      ADD_FAILURE() << text;
    } catch (const validation::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(text.substr(0, text.find(':'))), std::string::npos) << error.what();
    }
  }
  const JoySettings settings =
      read_joy_settings(YAML::Load("{axes: [1, 0, 4, -1, -1, 3], move_speed: 0.5, grasp_button: 3}"), "here");
  EXPECT_EQ(settings.axes, (std::array<int, 6>{1, 0, 4, -1, -1, 3}));
  EXPECT_EQ(settings.move_speed, 0.5);
  EXPECT_EQ(settings.grasp_button, 3);
}

}  // namespace
}  // namespace spring_workbench::tracker_driver::joy_motion_test
