#include "scene_objects.h"

#include <OgreEntity.h>
#include <OgreMeshManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreSubEntity.h>
#include <OgreTechnique.h>
#include <rviz/mesh_loader.h>
#include <rviz/ogre_helpers/shape.h>

#include <cmath>

#include "message_checks.h"
#include "resources.h"
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

/// Sets the scale of a node. The primitives of rviz have size 1, with the cylinder along y. Triangles of a description
/// are already scaled, mesh files are not.
void set_size(const ShapeDescription& shape, bool of_file, Ogre::SceneNode* node) {
  const auto& size = shape.size;
  if (shape.type == ShapeDescription::CYLINDER) {
    node->rotate(Ogre::Quaternion(Ogre::Degree(90), Ogre::Vector3::UNIT_X));
    node->setScale(static_cast<float>(size.x), static_cast<float>(size.z), static_cast<float>(size.y));
  } else if (shape.type != ShapeDescription::MESH || of_file) {
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
    for (const ShapeDescription& shape : description.visual) add_part(scene, shape, body);
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

void SceneObjects::add_part(const SceneDescription& scene, const ShapeDescription& shape, Body& body) {
  const bool is_mesh = shape.type == ShapeDescription::MESH;
  if (is_mesh && !meshes_[shape.mesh]) return;  // without triangles
  const Ogre::MeshPtr file =                    // also null if rviz cannot read it
      is_mesh && shape.file_colors != 0 ? rviz::loadMeshFromResource(scene.meshes[shape.mesh].uri) : Ogre::MeshPtr();
  Part part{body.node->createChildSceneNode(), file ? manager_->createEntity(file) : make_entity(shape), {}};
  set_pose(shape.pose, part.node);
  set_size(shape, bool(file), part.node);
  const auto& c = shape.color;
  if (!file) part.looks.push_back({make_material(), Ogre::ColourValue(c.r, c.g, c.b, c.a)});
  for (unsigned i = 0; file && i < part.entity->getNumSubEntities(); ++i) {
    const Ogre::MaterialPtr material = part.entity->getSubEntity(i)->getMaterial()->clone(unique_name("material"));
    part.looks.push_back({material, material->getTechnique(0)->getPass(0)->getDiffuse()});
  }
  for (unsigned i = 0; i < part.entity->getNumSubEntities(); ++i)
    part.entity->getSubEntity(i)->setMaterial(part.looks[file ? i : 0].material);
  for (const Look& look : part.looks) set_color(look.color, look.material);
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
    for (const Look& look : part.looks) {
      Ogre::ColourValue color = look.color;
      if (highlighted) {
        const Eigen::Vector3f lit = fork_mesh::highlighted(Vector3d(color.r, color.g, color.b)).cast<float>();
        color = Ogre::ColourValue(lit[0], lit[1], lit[2], color.a);
      }
      if (pierced) color.a *= static_cast<float>(fork_mesh::pierced_opacity);
      set_color(color, look.material);
    }
  }
}

void SceneObjects::clear() {
  for (auto& [name, body] : bodies_) {
    for (const Part& part : body.parts) {
      manager_->destroyEntity(part.entity);
      manager_->destroySceneNode(part.node);
      for (const Look& look : part.looks) remove_material(look.material);
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
