#include "world_frame.h"

#include <OgreSceneNode.h>
#include <ros/time.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>

namespace spring_workbench::rviz_plugin {

bool place_node(const std::string& frame, const QString& fixed_frame, rviz::DisplayContext* context,
                rviz::Display& display) {
  Ogre::Vector3 position = Ogre::Vector3::ZERO;
  Ogre::Quaternion rotation = Ogre::Quaternion::IDENTITY;
  if (frame != fixed_frame.toStdString() &&
      !context->getFrameManager()->getTransform(frame, ros::Time(), position, rotation)) {
    display.setStatus(rviz::StatusProperty::Error, "Transform",
                      "No transform from " + QString::fromStdString(frame) + " to " + fixed_frame);
    return false;
  }
  display.deleteStatus("Transform");
  display.getSceneNode()->setPosition(position);
  display.getSceneNode()->setOrientation(rotation);
  return true;
}

}  // namespace spring_workbench::rviz_plugin
