#include "scene_objects.h"

#include <OgreEntity.h>
#include <OgreMeshManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreSubEntity.h>
#include <OgreTechnique.h>
#include <rviz/mesh_loader.h>
#include <rviz/ogre_helpers/shape.h>

#include <chrono>

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

void SceneObjects::describe(const SceneDescriptionConstPtr& scene) {
  check(*scene);
  clear();
  scene_ = scene;
  meshes_ = std::make_unique<MeshPieces>(manager_, scene);
  std::deque<Work> of_triangles;
  for (const BodyDescription& description : scene->bodies) {
    Body& body = bodies_[description.name];
    body.movable = description.movable != 0;
    body.named = !body.movable;
    body.node = parent_->createChildSceneNode();
    set_pose(description.pose, body.node);
    for (const ShapeDescription& shape : description.visual) {
      const bool is_mesh = shape.type == ShapeDescription::MESH, of_file = is_mesh && shape.file_colors != 0;
      (is_mesh && !of_file ? of_triangles : waiting_).push_back({&body, &shape, of_file});
    }
  }
  waiting_.insert(waiting_.end(), of_triangles.begin(), of_triangles.end());
}

bool SceneObjects::build(double time) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(time);
  while (!waiting_.empty() && build_next()) {
    if (std::chrono::steady_clock::now() >= end) break;
  }
  return waiting_.empty();
}

/// Builds the next shape or a piece of it; returns false if it has to wait.
bool SceneObjects::build_next() {
  Work& work = waiting_.front();
  const std::size_t mesh = work.shape->mesh;
  Ogre::MeshPtr file;
  if (work.of_file) {
    file = rviz::loadMeshFromResource(scene_->meshes[mesh].uri);
    work.of_file = bool(file);  // otherwise rviz cannot read it, and its triangles are drawn
  }
  if (work.shape->type == ShapeDescription::MESH && !file) {
    const MeshPieces::Progress progress = meshes_->make_next(mesh);
    if (progress != MeshPieces::Progress::complete) return progress == MeshPieces::Progress::grows;
  }
  add_part(work, file);
  waiting_.pop_front();
  return true;
}

std::vector<Ogre::Entity*> SceneObjects::make_entities(const ShapeDescription& shape) {
  std::vector<Ogre::Entity*> entities;
  if (shape.type == ShapeDescription::MESH) {
    for (const Ogre::MeshPtr& piece : meshes_->of(shape.mesh)) entities.push_back(manager_->createEntity(piece));
    return entities;
  }
  const rviz::Shape::Type type = shape.type == ShapeDescription::BOX      ? rviz::Shape::Cube
                                 : shape.type == ShapeDescription::SPHERE ? rviz::Shape::Sphere
                                                                          : rviz::Shape::Cylinder;
  return {rviz::Shape::createEntity(unique_name("shape"), type, manager_)};
}

/// `file`: null if the shape has none.
void SceneObjects::add_part(const Work& work, const Ogre::MeshPtr& file) {
  const ShapeDescription& shape = *work.shape;
  Part part{work.body->node->createChildSceneNode(), {}, {}};
  part.entities = file ? std::vector<Ogre::Entity*>{manager_->createEntity(file)} : make_entities(shape);
  set_pose(shape.pose, part.node);
  set_size(shape, bool(file), part.node);
  const auto& c = shape.color;
  if (!file) part.looks.push_back({make_material(), Ogre::ColourValue(c.r, c.g, c.b, c.a)});
  for (Ogre::Entity* entity : part.entities) {
    for (unsigned i = 0; i < entity->getNumSubEntities(); ++i) {
      Ogre::SubEntity* sub = entity->getSubEntity(i);
      const Ogre::MaterialPtr own = file ? sub->getMaterial()->clone(unique_name("material")) : Ogre::MaterialPtr();
      if (file) part.looks.push_back({own, own->getTechnique(0)->getPass(0)->getDiffuse()});
      sub->setMaterial(part.looks[file ? i : 0].material);
    }
    part.node->attachObject(entity);
  }
  work.body->parts.push_back(part);
  color(*work.body, work.body->highlighted, work.body->pierced);
  work.body->node->setVisible(work.body->named);
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
  waiting_.clear();
  for (auto& [name, body] : bodies_) {
    for (const Part& part : body.parts) {
      for (Ogre::Entity* entity : part.entities) manager_->destroyEntity(entity);
      manager_->destroySceneNode(part.node);
      for (const Look& look : part.looks) remove_material(look.material);
    }
    if (body.node != nullptr) manager_->destroySceneNode(body.node);
  }
  bodies_.clear();
  meshes_.reset();
}

const Ogre::SceneNode* SceneObjects::node(const std::string& name) const {
  const auto found = bodies_.find(name);
  return found == bodies_.end() ? nullptr : found->second.node;
}

}  // namespace spring_workbench::rviz_plugin
