#pragma once

#ifndef Q_MOC_RUN
#include <OgreMaterial.h>
#include <ros/subscriber.h>
#include <rviz/display.h>

#include <memory>

#include "master_watch.h"
#include "spring_workbench/ForkState.h"
#include "spring_workbench/fork_mesh/fork_model.h"
#endif

namespace Ogre {
class ManualObject;
}
namespace rviz {
class RosTopicProperty;
}  // namespace rviz

namespace spring_workbench::rviz_plugin {

/// Draws the spring-fork from `ForkState` alone: the rod's curve from shape, length and strain, the mesh along it. At
/// most once a frame of rviz; gone when no message has come for two seconds.
class ForkDisplay : public rviz::Display {
  Q_OBJECT
 public:
  ForkDisplay();
  ~ForkDisplay() override;

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private:
  Q_SLOT void subscribe();
  void on_fork(const ForkStateConstPtr& message);
  bool deform(const ForkState& fork);
  void draw(const ForkState& fork);
  void fill(unsigned int section, const fork_mesh::ForkModel::Triangles& triangles, const Ogre::MaterialPtr& material,
            bool is_new);
  void hide();

  rviz::RosTopicProperty* topic_;
  ros::Subscriber subscriber_;
  std::shared_ptr<MasterWatch> master_;
  ForkStateConstPtr newest_;  ///< not yet drawn
  double silence_ = 0.0;      ///< since the newest message [s]
  std::string tool_ = "spring_fork";
  fork_mesh::ForkModel model_;  ///< of that tool
  fork_mesh::ForkMesh mesh_;
  Ogre::ManualObject* object_ = nullptr;
  Ogre::MaterialPtr spring_material_, rigid_material_;
};

}  // namespace spring_workbench::rviz_plugin
