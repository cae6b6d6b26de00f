#pragma once

#ifndef Q_MOC_RUN
#include <rviz/display.h>

#include <memory>
#include <optional>
#include <string>

#include "scene_objects.h"
#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/SceneDescription.h"
#include "spring_workbench/ros/common/subscriptions.h"
#endif

namespace rviz {
class RosTopicProperty;
}  // namespace rviz

namespace spring_workbench::rviz_plugin {

/// Draws the bodies of the scene. Builds them from the latched `SceneDescription`, once for each change of the scene,
/// a few in each frame, and moves them according to the newest `ObjectStates` at the start of each frame. Hidden if no
/// message has arrived for two seconds.
class ObjectsDisplay : public rviz::Display {
  Q_OBJECT
 public:
  ObjectsDisplay();

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

 protected:
  void onInitialize() override;
  void onEnable() override { subscribe(); }
  void onDisable() override;

 private:
  Q_SLOT void subscribe();
  void describe();
  void build();
  void place();
  void clear();

  rviz::RosTopicProperty *topic_, *scene_topic_;
  SceneDescriptionConstPtr scene_;     ///< not built yet
  ObjectStatesConstPtr newest_;        ///< not drawn yet
  std::optional<std::string> builds_;  ///< name of the scene whose shapes are being built
  std::string frame_;                  ///< frame of the poses; empty: nothing is shown
  double silence_ = 0.0;               ///< time since the newest valid message [s]
  std::unique_ptr<SceneObjects> objects_;
  ros_common::Subscriptions subscriptions_;
};

}  // namespace spring_workbench::rviz_plugin
