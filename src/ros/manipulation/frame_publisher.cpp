#include "spring_workbench/ros/manipulation/frame_publisher.h"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "constants.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/loop_clock.h"
#include "spring_workbench/ros/common/publishing.h"

namespace spring_workbench::manipulation {

FramePublisher::FramePublisher(ros::NodeHandle node, std::string world_frame, std::string frame_prefix)
    : world_frame_(std::move(world_frame)), frame_prefix_(std::move(frame_prefix)) {
  const auto count = [this](const ros::SingleSubscriberPublisher& subscriber, bool more) {
    if (subscriber.getSubscriberName() == ros::this_node::getName()) more ? ++own_subscriptions_ : --own_subscriptions_;
  };
  publisher_ = node.advertise<tf2_msgs::TFMessage>(
      "/tf", 100, [count](const auto& subscriber) { count(subscriber, true); },
      [count](const auto& subscriber) { count(subscriber, false); });
}

void FramePublisher::publish(const live::View& view, const ros::Time& stamp) {
  if (publisher_.getNumSubscribers() <= own_subscriptions_ || stamp.isZero() || stamp == stamp_) return;
  stamp_ = stamp;
  if (view.scene != scene_) name_frames(view);
  message_ = boost::make_shared<tf2_msgs::TFMessage>();
  add_tools(view);
  add_objects(view);
  publisher_.publish(message_);  // shared with this node's own subscription
}

void FramePublisher::name_frames(const live::View& view) {
  scene_ = view.scene;
  frames_.clear();
  X_OL_.clear();
  view.for_each_object([this](const bodies::BodyState& object, const scene::Body& body) {
    X_OL_.push_back(body.X_OL);
    frames_.push_back(ros_common::to_transform(object.X_WO * body.X_OL, world_frame_, frame_prefix_ + object.name, {}));
  });
  sent_ = view.objects;
  next_ = 0;
  turns_due_ = static_cast<double>(frames_.size());
}

void FramePublisher::add_tools(const live::View& view) {
  const auto add = [this](const RigidTransform& X_WF, const std::string& name) {
    message_->transforms.push_back(ros_common::to_transform(X_WF, world_frame_, frame_prefix_ + name, stamp_));
  };
  for (std::size_t hand = 0; hand < view.tools.size(); ++hand) {
    const tools::ToolState& tool = view.tools[hand];
    if (hand > 0 && !tool.present) continue;
    const std::string number = ros_common::hand_suffix(hand);
    add(tool.X_WH, "fork_handle" + number);
    add(tool.X_WE, "fork_tip" + number);
  }
}

std::size_t FramePublisher::turns(std::size_t objects) {
  const double now = ros_common::steady_time(), all = static_cast<double>(objects);
  turns_due_ = std::min(turns_due_ + (now - std::exchange(turned_at_, now)) / repeat_after * all, all);
  const auto turns = static_cast<std::size_t>(turns_due_);
  turns_due_ -= static_cast<double>(turns);
  return turns;
}

void FramePublisher::add_objects(const live::View& view) {
  const live::SharedStates& objects = view.objects;
  const std::size_t count = objects.size(), turns = this->turns(count);
  const auto in_turn = [&](std::size_t object) { return (object + count - next_) % count < turns; };
  const auto send = [&](std::size_t object) {
    message_->transforms.push_back(frames_[object]);
    message_->transforms.back().header.stamp = stamp_;
  };
  message_->transforms.reserve(message_->transforms.size() + turns);
  for (std::size_t part = 0; part < objects.parts().size(); ++part) {
    if (objects.shares(part, sent_)) continue;
    const std::size_t begin = live::SharedStates::begin_of(part);
    for (std::size_t i = begin; i < begin + objects.parts()[part]->size(); ++i) {
      if (sent_[i].X_WO.matrix() == objects[i].X_WO.matrix()) continue;
      frames_[i].transform = ros_common::to_transform(objects[i].X_WO * X_OL_[i], {}, {}, {}).transform;
      if (!in_turn(i)) send(i);
    }
  }
  for (std::size_t turn = 0; turn < turns; ++turn) send((next_ + turn) % count);
  if (count > 0) next_ = (next_ + turns) % count;
  sent_ = objects;
}

}  // namespace spring_workbench::manipulation
