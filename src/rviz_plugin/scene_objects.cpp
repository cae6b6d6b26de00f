#include "scene_objects.h"

#include <OgreEntity.h>
#include <OgreMeshManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/shape.h>

#include <cmath>

#include "material.h"
#include "mesh.h"
#include "message_checks.h"
#include "spring_workbench/fork_mesh/constants.h"
#include "spring_workbench/fork_mesh/load_color.h"

namespace spring_workbench::rviz_plugin {
namespace {

void set_pose(const geometry_msgs::Pose& pose, Ogre::SceneNode* node) {
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  node->setPosition(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  Ogre::Quaternion rotation(static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
                            static_cast<float>(q.z));
  rotation.normalise();
  node->setOrientation(rotation);
}

/// rviz' primitives are of size 1; its cylinder stands along y.
void set_size(const ShapeDescription& shape, Ogre::SceneNode* node) {
  const auto& size = shape.size;
  if (shape.type == ShapeDescription::CYLINDER) {
    node->rotate(Ogre::Quaternion(Ogre::Degree(90), Ogre::Vector3::UNIT_X));
    node->setScale(static_cast<float>(size.x), static_cast<float>(size.z), static_cast<float>(size.y));
  } else if (shape.type != ShapeDescription::MESH) {
    node->setScale(static_cast<float>(size.x), static_cast<float>(size.y), static_cast<float>(size.z));
  }
}

}  // namespace

SceneObjects::SceneObjects(Ogre::SceneManager* manager, Ogre::SceneNode* parent) : manager_(manager), parent_(parent) {}

SceneObjects::~SceneObjects() { clear(); }

void SceneObjects::describe(const SceneDescription& scene) {
  check(scene);
  clear();
  for (const MeshDescription& mesh : scene.meshes) meshes_.push_back(make_mesh(mesh, manager_));
  for (const BodyDescription& description : scene.bodies) {
    Body& body = bodies_[description.name];
    body.movable = description.movable != 0;
    body.named = !body.movable;
    body.node = parent_->createChildSceneNode();
    set_pose(description.pose, body.node);
    for (const ShapeDescription& shape : description.visual) add_part(shape, body);
    body.node->setVisible(body.named);
  }
}

Ogre::Entity* SceneObjects::make_entity(const ShapeDescription& shape) {
  if (shape.type == ShapeDescription::MESH) return manager_->createEntity(meshes_[shape.mesh]);
  const rviz::Shape::Type type = shape.type == ShapeDescription::BOX      ? rviz::Shape::Cube
                                 : shape.type == ShapeDescription::SPHERE ? rviz::Shape::Sphere
                                                                          : rviz::Shape::Cylinder;
  return rviz::Shape::createEntity(unique_name("shape"), type, manager_);
}

void SceneObjects::add_part(const ShapeDescription& shape, Body& body) {
  if (shape.type == ShapeDescription::MESH && !meshes_[shape.mesh]) return;  // without triangles
  Part part{body.node->createChildSceneNode(), make_entity(shape), make_material(), shape.color};
  set_pose(shape.pose, part.node);
  set_size(shape, part.node);
  set_color(shape.color, part.material);
  part.entity->setMaterial(part.material);
  part.node->attachObject(part.entity);
  body.parts.push_back(part);
  ++built_;
}

void SceneObjects::place(const ObjectStates& objects) {
  for (const ObjectState& object : objects.objects) check(object.pose, object.name);
  for (auto& [name, body] : bodies_) body.named = !body.movable;
  for (const ObjectState& object : objects.objects) {
    const auto found = bodies_.find(object.name);
    if (found == bodies_.end()) continue;
    Body& body = found->second;
    body.named = true;
    set_pose(object.pose, body.node);
    const bool lit = object.highlighted != 0, pierced = lit || object.held != 0;
    if (body.highlighted != lit || body.pierced != pierced) color(body, lit, pierced);
  }
  for (auto& [name, body] : bodies_) body.node->setVisible(body.named);
}

void SceneObjects::color(Body& body, bool highlighted, bool pierced) {
  body.highlighted = highlighted;
  body.pierced = pierced;
  for (const Part& part : body.parts) {
    std_msgs::ColorRGBA color = part.color;
    if (pierced) color.a *= static_cast<float>(fork_mesh::pierced_opacity);
    if (highlighted) {
      const Eigen::Vector3f lit = fork_mesh::highlighted(Vector3d(color.r, color.g, color.b)).cast<float>();
      color.r = lit[0];
      color.g = lit[1];
      color.b = lit[2];
    }
    set_color(color, part.material);
  }
}

void SceneObjects::clear() {
  for (auto& [name, body] : bodies_) {
    for (const Part& part : body.parts) {
      manager_->destroyEntity(part.entity);
      manager_->destroySceneNode(part.node);
      remove_material(part.material);
    }
    if (body.node != nullptr) manager_->destroySceneNode(body.node);
  }
  bodies_.clear();
  for (const Ogre::MeshPtr& mesh : meshes_) remove_mesh(mesh);
  meshes_.clear();
}

const Ogre::SceneNode* SceneObjects::node(const std::string& name) const {
  const auto found = bodies_.find(name);
  return found == bodies_.end() ? nullptr : found->second.node;
}

}  // namespace spring_workbench::rviz_plugin
