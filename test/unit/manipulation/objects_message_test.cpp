#include "spring_workbench/ros/manipulation/objects_message.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "spring_workbench/ros/common/conversions.h"
#include "support/bench_scenes.h"
#include "support/temporary_folder.h"

namespace spring_workbench::manipulation::objects_message_test {
namespace {

scene::Scene row(std::size_t count, const std::string& name) {
  std::vector<scene::Body> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d p(0.1 * (static_cast<double>(i) - 0.5 * static_cast<double>(count)), 0.0, 0.02);
    boxes.push_back(box(name + std::to_string(i), Vector3d(0.04, 0.04, 0.04), 0.1, p));
  }
  return scene_of(boxes, scene::ContactMode::none);
}

/// A simulation with random events.
class Story {
 public:
  explicit Story(unsigned seed) : random_(seed) {
    folder_.write("brick.urdf",
                  "<robot name='brick'><link name='brick'><inertial><mass value='0.1'/><inertia ixx='1e-4' iyy='1e-4' "
                  "izz='1e-4' ixy='0' ixz='0' iyz='0'/></inertial></link></robot>");
  }
  void go_on() {
    const std::size_t what = random(12), any = random(std::max<std::size_t>(simulation_.objects().size(), 1));
    const bool none = simulation_.objects().empty();
    const std::string name = none ? "" : simulation_.objects()[any].name;
    const auto pose = make_transform({0.1 * static_cast<double>(random(10)), 0.0, 0.5}, Quaterniond::Identity());
    if (what == 0) begin();
    if (what == 1) simulation_.reset();
    if (what == 2) edit({Action::add, std::string(1 + random(20), 'b') + std::to_string(added_++), brick(), pose});
    if (what == 3 && !none) edit({Action::remove, name, "", std::nullopt});
    if (what == 4 && !none && !simulation_.objects()[any].held) edit({Action::move, name, "", pose});
    if (what == 5) simulation_.push_button(t_, pressed_ = !pressed_);
    if (what < 6) return;
    t_ += 0.01;
    simulation_.push_stylus({t_, pointing_down({0.05 * std::sin(3.0 * t_), 0.0, 0.22})});
    simulation_.advance_to(t_);
  }
  const simulation::Simulation& simulation() const { return simulation_; }
  std::size_t random(std::size_t below) { return random_() % below; }

 private:
  using Action = simulation::ObjectEdit::Action;
  void begin() {
    constexpr std::size_t counts[] = {0, 1, 32, 33, 100};
    simulation_ = simulation::Simulation(row(counts[random(5)], random(2) == 0 ? "box" : "another box "), {});
    t_ = 0.0;
    pressed_ = false;
  }
  void edit(const simulation::ObjectEdit& edit) { simulation_.edit(edit); }
  std::string brick() const { return folder_.path("brick.urdf"); }

  std::mt19937 random_;
  test_support::TemporaryFolder folder_;
  simulation::Simulation simulation_{row(70, "box"), {}};
  std::size_t added_ = 0;
  double t_ = 0.0;
  bool pressed_ = false;
};

ros::SerializedMessage serialised_anew(const std_msgs::Header& header, const std::vector<bodies::BodyState>& objects) {
  ObjectStates message;
  message.header = header;
  for (const bodies::BodyState& object : objects) {
    ObjectState state;
    state.name = object.name;
    state.pose = ros_common::to_pose(object.X_WO);
    state.twist.linear = ros_common::to_vector(object.V_WO_W.linear);
    state.twist.angular = ros_common::to_vector(object.V_WO_W.angular);
    state.held = object.held;
    state.highlighted = object.highlighted;
    state.in_contact = object.in_contact;
    state.asleep = object.asleep;
    message.objects.push_back(state);
  }
  return ros::serialization::serializeMessage(message);
}

std::vector<std::uint8_t> bytes_of(const ros::SerializedMessage& message) {
  return {message.buf.get(), message.buf.get() + message.num_bytes};
}

/// Objects move, are added, removed and renamed, and the frame of the header changes. Messages that roscpp has not sent
/// yet stay unchanged, whatever is written later.
TEST(ObjectsMessage, HasTheBytesOfAFreshlySerialisedMessage) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Story story(seed);
    ObjectsMessage message;
    live::SharedStates states;
    std::deque<std::pair<ros::SerializedMessage, std::vector<std::uint8_t>>> unsent;
    for (unsigned k = 0; k < 200; ++k) {
      story.go_on();
      states.update_from(story.simulation());
      std_msgs::Header header;
      header.frame_id = k / 50 % 2 == 0 ? "world" : "another world";
      header.stamp.fromSec(0.01 * k);
      message.write(header, states);
      const ros::SerializedMessage sent = ros::serialization::serializeMessage(message);
      const ros::SerializedMessage must = serialised_anew(header, story.simulation().objects());
      ASSERT_EQ(bytes_of(sent), bytes_of(must)) << "seed " << seed << ", message " << k;
      EXPECT_EQ(sent.message_start - sent.buf.get(), must.message_start - must.buf.get());
      header.seq = k;  // as roscpp writes it
      ros::serialization::OStream stream(sent.message_start, static_cast<std::uint32_t>(sent.num_bytes) - 4);
      stream.next(header);
      unsent.emplace_back(sent, bytes_of(sent));
      for (std::size_t most = story.random(8); unsent.size() > most; unsent.pop_front())
        EXPECT_EQ(bytes_of(unsent.front().first), unsent.front().second) << "seed " << seed << ", message " << k;
    }
  }
}

TEST(ObjectsMessage, IsWrittenOverOnesThatAreSent) {
  Story story(1);
  ObjectsMessage message;
  live::SharedStates states;
  states.update_from(story.simulation());
  std::set<const std::uint8_t*> buffers;
  for (int k = 0; k < 20; ++k) {
    message.write({}, states);
    buffers.insert(ros::serialization::serializeMessage(message).buf.get());
  }
  EXPECT_EQ(buffers.size(), 3u);
}

}  // namespace
}  // namespace spring_workbench::manipulation::objects_message_test
