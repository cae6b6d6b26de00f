#include "head_view_controller.h"

#include <OgreCamera.h>
#include <OgreSceneNode.h>
#include <ros/time.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/tf_frame_property.h>
#include <tf2_ros/buffer.h>

#include <pluginlib/class_list_macros.hpp>
#include <utility>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::rviz_plugin {
namespace {

RigidTransform pose_of(const geometry_msgs::Transform& message) {
  const auto& p = message.translation;
  const auto& q = message.rotation;
  return make_transform(Vector3d(p.x, p.y, p.z), Quaterniond(q.w, q.x, q.y, q.z));
}

}  // namespace

HeadViewController::HeadViewController() {
  frame_ =
      new rviz::TfFrameProperty("Head Frame", "head", "The camera looks along its x axis; its z axis is up.", this);
  latency_ = new rviz::FloatProperty(
      "Latency", 0.0F, "Delay of projector and rviz [s]: the head's pose is predicted this far ahead.", this);
  latency_->setMin(0.0F);
  latency_->setMax(static_cast<float>(motion::PosePredictor::farthest));
}

void HeadViewController::onInitialize() { frame_->setFrameManager(context_->getFrameManager()); }

void HeadViewController::update(float, float) {
  const std::string frame = frame_->getFrameStd(), fixed = context_->getFrameManager()->getFixedFrame();
  geometry_msgs::TransformStamped newest;
  try {
    newest = context_->getTF2BufferPtr()->lookupTransform(fixed, frame, ros::Time());
  } catch (const tf2::TransformException&) {
    return setStatus("no frame " + frame_->getFrame() + ": the view does not move");
  }
  setStatus("following " + frame_->getFrame());
  if (std::exchange(followed_, fixed + " " + frame) != followed_) motion_ = motion::HeadMotion();
  const RigidTransform X_FH = motion_.update(newest.header.stamp.toSec(), pose_of(newest.transform),
                                             ros::SteadyTime::now().toSec(), static_cast<double>(latency_->getFloat()));
  const Eigen::Vector3f p = X_FH.translation().cast<float>();
  const Eigen::Quaternionf q(X_FH.linear().cast<float>());
  // Ogre's cameras look along -z, y up.
  const Ogre::Quaternion camera_in_head(Ogre::Vector3(0, -1, 0), Ogre::Vector3(0, 0, 1), Ogre::Vector3(-1, 0, 0));
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"  // rviz attaches its cameras to the scene's root
  camera_->setPosition(p.x(), p.y(), p.z());
  camera_->setOrientation(Ogre::Quaternion(q.w(), q.x(), q.y(), q.z()) * camera_in_head);
#pragma GCC diagnostic pop
}

}  // namespace spring_workbench::rviz_plugin

PLUGINLIB_EXPORT_CLASS(spring_workbench::rviz_plugin::HeadViewController, rviz::ViewController)
