#include "objects_display.h"

#include <OgreException.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <ros/message_traits.h>
#include <rviz/display_context.h>
#include <rviz/properties/ros_topic_property.h>

#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "constants.h"
#include "shared_master_watch.h"
#include "spring_workbench/validation/input_error.h"
#include "world_frame.h"

namespace spring_workbench::rviz_plugin {

using rviz::StatusProperty;

ObjectsDisplay::ObjectsDisplay() {
  topic_ = new rviz::RosTopicProperty(
      "Topic", "manipulation/display/objects", QString::fromStdString(ros::message_traits::datatype<ObjectStates>()),
      "Topic ~display/objects of manipulation: the poses.", this, SLOT(subscribe()), this);
  scene_topic_ = new rviz::RosTopicProperty("Scene Topic", "manipulation/scene_description",
                                            QString::fromStdString(ros::message_traits::datatype<SceneDescription>()),
                                            "Topic ~scene_description of manipulation: the shapes.", this,
                                            SLOT(subscribe()), this);
}

void ObjectsDisplay::onInitialize() {
  objects_ = std::make_unique<SceneObjects>(scene_manager_, scene_node_);
  shared_master_watch();
}

void ObjectsDisplay::onDisable() {
  subscriptions_.end();
  clear();
}

void ObjectsDisplay::setTopic(const QString& topic, const QString&) { topic_->setString(topic); }

void ObjectsDisplay::clear() {
  scene_.reset();
  newest_.reset();
  frame_.clear();
  builds_.reset();
  if (objects_) objects_->clear();
}

void ObjectsDisplay::subscribe() {
  if (!initialized()) return;
  subscriptions_.end();
  clear();
  if (!isEnabled() || topic_->getTopicStd().empty() || scene_topic_->getTopicStd().empty()) return;
  setStatus(StatusProperty::Warn, "Topic", "No message yet");
  setStatus(StatusProperty::Warn, "Scene", "No description yet");
  subscriptions_.add<ObjectStates>(update_nh_, topic_->getTopicStd(), 1,
                                   [this](const auto& message) { newest_ = message; });
  subscriptions_.add<SceneDescription>(update_nh_, scene_topic_->getTopicStd(), 1,
                                       [this](const auto& message) { scene_ = message; });
}

void ObjectsDisplay::reset() {
  Display::reset();
  subscribe();
}

/// The callbacks have just run in this thread, so the frame shows the newest message.
void ObjectsDisplay::update(float wall_dt, float) {
  silence_ += static_cast<double>(wall_dt);
  if (scene_) describe();
  if (builds_) build();
  if (newest_) place();
  if (silence_ > longest_silence && !frame_.empty()) {
    frame_.clear();
    setStatus(StatusProperty::Warn, "Topic", "No messages: is manipulation running?");
  }
  if (frame_.empty() || !place_node(frame_, fixed_frame_, context_, *this)) scene_node_->setVisible(false);
}

void ObjectsDisplay::describe() {
  const SceneDescriptionConstPtr scene = std::move(scene_);
  scene_.reset();
  try {
    objects_->describe(scene);
    builds_ = scene->name;
    setStatus(StatusProperty::Warn, "Scene", "Building the shapes");
  } catch (const validation::InputError& error) {
    setStatusStd(StatusProperty::Error, "Scene", error.what());
  }
}

void ObjectsDisplay::build() {
  try {
    context_->queueRender();
    if (!objects_->build(build_time)) return;
    setStatusStd(StatusProperty::Ok, "Scene", std::to_string(objects_->bodies()) + " bodies of " + *builds_);
  } catch (const Ogre::Exception& error) {
    setStatusStd(StatusProperty::Error, "Scene", error.getDescription());
  }
  builds_.reset();
}

void ObjectsDisplay::place() {
  const ObjectStatesConstPtr objects = std::move(newest_);
  newest_.reset();
  try {
    scene_node_->setVisible(true);
    objects_->place(*objects);
    frame_ = objects->header.frame_id;
    silence_ = 0.0;
    setStatus(StatusProperty::Ok, "Topic", "Drawing");
    context_->queueRender();
  } catch (const validation::InputError& error) {
    setStatusStd(StatusProperty::Error, "Topic", error.what());
  }
}

}  // namespace spring_workbench::rviz_plugin

PLUGINLIB_EXPORT_CLASS(spring_workbench::rviz_plugin::ObjectsDisplay, rviz::Display)
