#include "fork_display.h"

#include <ros/message_traits.h>
#include <rviz/display_context.h>
#include <rviz/properties/ros_topic_property.h>

#include <pluginlib/class_list_macros.hpp>
#include <string>
#include <utility>

#include "constants.h"
#include "spring_workbench/validation/input_error.h"
#include "world_frame.h"

namespace spring_workbench::rviz_plugin {

using rviz::StatusProperty;

ForkDisplay::ForkDisplay() {
  topic_ = new rviz::RosTopicProperty(
      "Topic", "manipulation/display/fork", QString::fromStdString(ros::message_traits::datatype<ForkState>()),
      "Topic ~display/fork of manipulation; the forks of further styluses are drawn, too.", this, SLOT(subscribe()),
      this);
}

void ForkDisplay::setTopic(const QString& topic, const QString&) { topic_->setString(topic); }

void ForkDisplay::subscribe() {
  if (!initialized()) return;
  for (auto& [topic, fork] : forks_) fork.subscription.end();
  forks_.clear();
  last_answer_.reset();
  if (!isEnabled() || topic_->getTopicStd().empty()) return;
  setStatus(StatusProperty::Warn, "Topic", "No message yet");
  listen(update_nh_.resolveName(topic_->getTopicStd()));
}

void ForkDisplay::reset() {
  Display::reset();
  subscribe();
}

void ForkDisplay::listen(const std::string& topic) {
  const auto [entry, is_new] = forks_.try_emplace(topic, scene_manager_, scene_node_);
  if (!is_new) return;
  Fork& fork = entry->second;
  fork.subscription.add<ForkState>(update_nh_, topic, 1, [&fork](const ForkStateConstPtr& message) {
    fork.newest = message;
    fork.silence = 0.0;
  });
}

/// Subscribes to the topic and to all topics whose names extend it by _2, _3 and so on.
void ForkDisplay::listen_to_all() {
  const auto answer = shared_master_watch().answer();
  if (forks_.empty() || answer == std::exchange(last_answer_, answer)) return;
  const std::string begin = forks_.begin()->first + "_";
  for (const auto& [topic, publishers] : answer->publishers) {
    const bool has_number = topic.find_first_not_of("0123456789", begin.size()) == std::string::npos;
    if (topic.size() > begin.size() && topic.rfind(begin, 0) == 0 && has_number) listen(topic);
  }
}

void ForkDisplay::update(float wall_dt, float) {
  listen_to_all();
  for (auto& [topic, fork] : forks_) {
    fork.silence += static_cast<double>(wall_dt);
    if (fork.silence > longest_silence && fork.drawn.visible()) {
      fork.drawn.hide();
      setStatus(StatusProperty::Warn, "Topic", "No messages: is manipulation running?");
    }
    if (fork.newest) draw(fork);
  }
}

void ForkDisplay::draw(Fork& fork) {
  const ForkStateConstPtr message = std::move(fork.newest);
  fork.newest.reset();
  fork.drawn.hide();
  if (!place_node(message->header.frame_id, fixed_frame_, context_, *this)) return;
  try {
    fork.drawn.draw(*message);
    setStatus(StatusProperty::Ok, "Topic", "Drawing");
    context_->queueRender();
  } catch (const validation::InputError& error) {
    setStatus(StatusProperty::Error, "Topic", error.what());
  }
}

}  // namespace spring_workbench::rviz_plugin

PLUGINLIB_EXPORT_CLASS(spring_workbench::rviz_plugin::ForkDisplay, rviz::Display)
