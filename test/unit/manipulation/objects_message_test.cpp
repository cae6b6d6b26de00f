#include "spring_workbench/ros/manipulation/objects_message.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "spring_workbench/ros/common/conversions.h"
#include "support/bench_scenes.h"

namespace spring_workbench::manipulation::objects_message_test {
namespace {

scene::Scene row(std::size_t count) {
  std::vector<scene::Body> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d p(0.1 * (static_cast<double>(i) - 0.5 * static_cast<double>(count)), 0.0, 0.02);
    boxes.push_back(box("box" + std::to_string(i), Vector3d(0.04, 0.04, 0.04), 0.1, p));
  }
  return scene_of(boxes, scene::ContactMode::none);
}

/// As a subscriber gets it.
ObjectStates received(const ObjectsMessage& message) {
  const ros::SerializedMessage sent = ros::serialization::serializeMessage(message);
  ObjectStates result;
  ros::serialization::deserializeMessage(sent, result);
  EXPECT_EQ(ros::serialization::serializationLength(result) + 4, sent.num_bytes);
  return result;
}

void expect_same(const ObjectStates& message, const std::vector<bodies::BodyState>& objects) {
  ASSERT_EQ(message.objects.size(), objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ObjectState& is = message.objects[i];
    const bodies::BodyState& must = objects[i];
    EXPECT_EQ(is.name, must.name);
    EXPECT_EQ(is.pose, ros_common::to_pose(must.X_WO)) << must.name;
    EXPECT_EQ(is.twist.linear, ros_common::to_vector(must.V_WO_W.linear)) << must.name;
    EXPECT_EQ(is.twist.angular, ros_common::to_vector(must.V_WO_W.angular)) << must.name;
    EXPECT_EQ(is.held != 0, must.held);
    EXPECT_EQ(is.highlighted != 0, must.highlighted);
    EXPECT_EQ(is.in_contact != 0, must.in_contact);
    EXPECT_EQ(is.asleep != 0, must.asleep);
  }
}

/// Also of other scenes: with more objects, fewer, and other names.
TEST(ObjectsMessage, IsReadAsTheStatesOfAllObjects) {
  ObjectsMessage message;
  message.header.frame_id = "world";
  for (const std::size_t count : {100, 33, 0, 1, 1200}) {
    simulation::Simulation simulation(row(count), {});
    live::SharedStates states;
    for (int k = 0; k < 100; ++k) {
      const double t = 0.01 * k;
      simulation.push_stylus({t, pointing_down({0.05 * std::sin(3.0 * t), 0.0, 0.22})});
      if (k == 20 || k == 70) simulation.push_button(t, k == 20);
      if (k == 90 && count > 50) simulation.edit({simulation::ObjectEdit::Action::remove, "box7", "", std::nullopt});
      simulation.advance(t);
      if (k % 9 != 0) continue;
      states.follow(simulation);
      message.write(states);
      const ObjectStates seen = received(message);
      EXPECT_EQ(seen.header.frame_id, "world");
      expect_same(seen, simulation.objects());
    }
  }
}

}  // namespace
}  // namespace spring_workbench::manipulation::objects_message_test
