#include "head_view_controller.h"

#include <OgreCamera.h>
#include <OgreSceneNode.h>
#include <ros/time.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/tf_frame_property.h>

#include <pluginlib/class_list_macros.hpp>

namespace spring_workbench::rviz_plugin {

HeadViewController::HeadViewController() {
  frame_ =
      new rviz::TfFrameProperty("Head Frame", "head", "The camera looks along its x axis; its z axis is up.", this);
}

void HeadViewController::onInitialize() { frame_->setFrameManager(context_->getFrameManager()); }

void HeadViewController::update(float, float) {
  Ogre::Vector3 position;
  Ogre::Quaternion rotation;
  if (!context_->getFrameManager()->getTransform(frame_->getFrameStd(), ros::Time(), position, rotation)) {
    return setStatus("no frame " + frame_->getFrame() + ": the view stays");
  }
  setStatus("following " + frame_->getFrame());
  // Ogre's cameras look along -z, y up.
  const Ogre::Quaternion camera_in_head(Ogre::Vector3(0, -1, 0), Ogre::Vector3(0, 0, 1), Ogre::Vector3(-1, 0, 0));
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"  // rviz hangs its cameras into the scene's root
  camera_->setPosition(position);
  camera_->setOrientation(rotation * camera_in_head);
#pragma GCC diagnostic pop
}

}  // namespace spring_workbench::rviz_plugin

PLUGINLIB_EXPORT_CLASS(spring_workbench::rviz_plugin::HeadViewController, rviz::ViewController)
