#include "drawn_fork.h"

#include <OgreManualObject.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include <algorithm>

#include "message_checks.h"
#include "resources.h"
#include "spring_workbench/fork_mesh/load_color.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::rviz_plugin {

DrawnFork::DrawnFork(Ogre::SceneManager* manager, Ogre::SceneNode* parent)
    : manager_(manager),
      object_(manager->createManualObject()),
      spring_material_(make_material()),
      rigid_material_(make_material()),
      model_(fork_mesh::appearance_of(tool_)) {
  object_->setDynamic(true);
  parent->attachObject(object_);
  set_color(Ogre::ColourValue(0.55F, 0.58F, 0.63F), rigid_material_);
}

DrawnFork::~DrawnFork() {
  manager_->destroyManualObject(object_);
  remove_material(spring_material_);
  remove_material(rigid_material_);
}

void DrawnFork::deform(const ForkState& fork) {
  const auto shape = rod::make_shape_model(validation::named<rod::ShapeKind>(fork.shape, "fork", "shape"), fork.length);
  const rod::StrainVector q = Eigen::Map<const Eigen::VectorXd>(
      fork.strain.data(),
      std::min<Eigen::Index>(static_cast<Eigen::Index>(fork.strain.size()), rod::max_strain_coordinates));
  validation::check_number("fork", "load", fork.load, validation::between(0.0, 1.0));
  validation::check_number("fork", "diameter", fork.diameter, validation::positive());
  if (q.size() != shape->size() || !shape->admissible(q) || !is_pose(fork.proxy_handle)) {
    validation::refuse("fork", "strain, proxy_handle",
                       "finite numbers that are possible for a rod of shape " + fork.shape);
  }
  const auto& p = fork.proxy_handle.position;
  const auto& r = fork.proxy_handle.orientation;
  const RigidTransform X_WH = make_transform(Vector3d(p.x, p.y, p.z), Quaterniond(r.w, r.x, r.y, r.z));
  if (fork.tool != tool_) {
    model_ = fork_mesh::ForkModel(fork_mesh::appearance_of(fork.tool));
    tool_ = fork.tool;
    object_->clear();
  }
  model_.deform(fork_mesh::rod_curve(*shape, q, X_WH), fork.diameter, mesh_);
}

void DrawnFork::draw(const ForkState& fork) {
  deform(fork);
  const Eigen::Vector3f c = fork_mesh::load_color(fork.load).cast<float>();
  set_color(Ogre::ColourValue(c.x(), c.y(), c.z()), spring_material_);
  const bool is_new = object_->getSections().empty();
  fill(0, model_.shaft_and_end(), rigid_material_, is_new);
  if (!model_.spring().empty()) fill(1, model_.spring(), spring_material_, is_new);
  object_->setVisible(true);
}

void DrawnFork::fill(unsigned int section, const fork_mesh::ForkModel::Triangles& triangles,
                     const Ogre::MaterialPtr& material, bool is_new) {
  if (is_new) {
    object_->estimateVertexCount(mesh_.vertices.size());
    object_->estimateIndexCount(3 * triangles.size());
    object_->begin(material->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, material->getGroup());
  } else {
    object_->beginUpdate(section);
  }
  for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
    const Eigen::Vector3f p = mesh_.vertices[i].cast<float>(), n = mesh_.normals[i].cast<float>();
    object_->position(p.x(), p.y(), p.z());
    object_->normal(n.x(), n.y(), n.z());
  }
  for (const Eigen::Vector3i& t : triangles) {
    object_->triangle(static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]), static_cast<unsigned>(t[2]));
  }
  object_->end();
}

void DrawnFork::hide() { object_->setVisible(false); }

bool DrawnFork::visible() const { return object_->isVisible(); }

}  // namespace spring_workbench::rviz_plugin
