#include "fork_display.h"

#include <OgreManualObject.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <ros/message_traits.h>
#include <rviz/display_context.h>
#include <rviz/properties/ros_topic_property.h>

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "constants.h"
#include "material.h"
#include "message_checks.h"
#include "spring_workbench/fork_mesh/load_color.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/number_rule.h"
#include "world_frame.h"

namespace spring_workbench::rviz_plugin {
namespace {

using rviz::StatusProperty;

Ogre::Vector3 to_ogre(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Ogre::ColourValue load_color(double place) {
  const Vector3d c = fork_mesh::load_color(place);
  return Ogre::ColourValue(static_cast<float>(c.x()), static_cast<float>(c.y()), static_cast<float>(c.z()));
}

}  // namespace

ForkDisplay::ForkDisplay() : model_(fork_mesh::look_of(tool_)) {
  topic_ = new rviz::RosTopicProperty(
      "Topic", "manipulation/display/fork", QString::fromStdString(ros::message_traits::datatype<ForkState>()),
      "The fork as it is shown, ~display/fork of manipulation.", this, SLOT(subscribe()), this);
}

ForkDisplay::~ForkDisplay() {
  subscriber_.shutdown();
  if (object_) scene_manager_->destroyManualObject(object_);
  remove_material(spring_material_);
  remove_material(rigid_material_);
}

void ForkDisplay::onInitialize() {
  object_ = scene_manager_->createManualObject();
  object_->setDynamic(true);
  scene_node_->attachObject(object_);
  spring_material_ = make_material();
  rigid_material_ = make_material();
  set_color(Ogre::ColourValue(0.55F, 0.58F, 0.63F), rigid_material_);
  master_ = MasterWatch::shared();
}

void ForkDisplay::onEnable() { subscribe(); }

void ForkDisplay::onDisable() {
  subscriber_.shutdown();
  hide();
}

void ForkDisplay::setTopic(const QString& topic, const QString&) { topic_->setString(topic); }

void ForkDisplay::subscribe() {
  if (!initialized()) return;
  subscriber_.shutdown();
  hide();
  if (!isEnabled() || topic_->getTopicStd().empty()) return;
  setStatus(StatusProperty::Warn, "Topic", "No message yet");
  subscriber_ =
      update_nh_.subscribe(topic_->getTopicStd(), 1, &ForkDisplay::on_fork, this, ros::TransportHints().tcpNoDelay());
}

void ForkDisplay::reset() {
  Display::reset();
  subscribe();
}

void ForkDisplay::on_fork(const ForkStateConstPtr& message) {
  newest_ = message;
  silence_ = 0.0;
}

void ForkDisplay::update(float wall_dt, float) {
  silence_ += static_cast<double>(wall_dt);
  if (silence_ > longest_silence && object_->isVisible()) {
    hide();
    setStatus(StatusProperty::Warn, "Topic", "Silent: is manipulation running?");
  }
  if (!newest_) return;
  const ForkStateConstPtr fork = newest_;
  newest_.reset();
  if (!place_node(fork->header.frame_id, fixed_frame_, context_, *this) || !deform(*fork)) return hide();
  draw(*fork);
  setStatus(StatusProperty::Ok, "Topic", "Drawing");
  context_->queueRender();
}

bool ForkDisplay::deform(const ForkState& fork) {
  try {
    const auto shape =
        rod::make_shape_model(validation::named<rod::ShapeKind>(fork.shape, "fork", "shape"), fork.length);
    const rod::StrainVector q = Eigen::Map<const Eigen::VectorXd>(
        fork.strain.data(),
        std::min<Eigen::Index>(static_cast<Eigen::Index>(fork.strain.size()), rod::max_strain_coordinates));
    validation::check_number("fork", "load", fork.load, validation::between(0.0, 1.0));
    validation::check_number("fork", "diameter", fork.diameter, validation::positive());
    if (q.size() != shape->size() || !shape->admissible(q) || !is_pose(fork.proxy_handle)) {
      throw validation::InputError("fork: strain, proxy_handle: must be finite and possible for a rod of shape " +
                                   fork.shape);
    }
    const auto& p = fork.proxy_handle.position;
    const auto& r = fork.proxy_handle.orientation;
    const RigidTransform X_WH = make_transform(Quaterniond(r.w, r.x, r.y, r.z), Vector3d(p.x, p.y, p.z));
    if (fork.tool != tool_) {
      model_ = fork_mesh::ForkModel(fork_mesh::look_of(fork.tool));
      tool_ = fork.tool;
      object_->clear();
    }
    model_.deform(fork_mesh::rod_curve(*shape, q, X_WH), fork.diameter, mesh_);
    return true;
  } catch (const validation::InputError& error) {
    setStatus(StatusProperty::Error, "Topic", error.what());
    return false;
  }
}

void ForkDisplay::draw(const ForkState& fork) {
  set_color(load_color(fork.load), spring_material_);
  const bool is_new = object_->getSections().empty();
  fill(0, model_.shaft_and_end(), rigid_material_, is_new);
  if (!model_.spring().empty()) fill(1, model_.spring(), spring_material_, is_new);
  object_->setVisible(true);
}

void ForkDisplay::fill(unsigned int section, const fork_mesh::ForkModel::Triangles& triangles,
                       const Ogre::MaterialPtr& material, bool is_new) {
  if (is_new) {
    object_->estimateVertexCount(mesh_.vertices.size());
    object_->estimateIndexCount(3 * triangles.size());
    object_->begin(material->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, material->getGroup());
  } else {
    object_->beginUpdate(section);
  }
  for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
    object_->position(to_ogre(mesh_.vertices[i]));
    object_->normal(to_ogre(mesh_.normals[i]));
  }
  for (const Eigen::Vector3i& t : triangles) {
    object_->triangle(static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]), static_cast<unsigned>(t[2]));
  }
  object_->end();
}

void ForkDisplay::hide() {
  newest_.reset();
  if (object_) object_->setVisible(false);
}

}  // namespace spring_workbench::rviz_plugin

PLUGINLIB_EXPORT_CLASS(spring_workbench::rviz_plugin::ForkDisplay, rviz::Display)
