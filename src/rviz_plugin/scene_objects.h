#pragma once

#ifndef Q_MOC_RUN
#include <OgreMaterial.h>
#include <OgreMesh.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/SceneDescription.h"
#endif

namespace Ogre {
class Entity;
class SceneManager;
class SceneNode;
}  // namespace Ogre

namespace spring_workbench::rviz_plugin {

/// The bodies of a scene in Ogre: built once from their description, then only moved and coloured. Frees all its
/// resources.
class SceneObjects {
 public:
  /// Adds the bodies below `parent`, which must outlive it.
  SceneObjects(Ogre::SceneManager* manager, Ogre::SceneNode* parent);
  ~SceneObjects();
  SceneObjects(const SceneObjects&) = delete;
  SceneObjects& operator=(const SceneObjects&) = delete;

  /// Replaces the present bodies. Fixed bodies are shown at once, movable ones from their first pose on. Throws
  /// InputError, and changes nothing, if the scene cannot be drawn.
  void describe(const SceneDescription& scene);
  /// Moves the movable bodies. A body that the message does not contain is hidden; an unknown name is ignored. Throws
  /// InputError, and changes nothing, if a pose is invalid.
  void place(const ObjectStates& objects);
  /// Removes all bodies.
  void clear();

  std::size_t bodies() const { return bodies_.size(); }
  std::size_t built() const { return built_; }  ///< number of shapes built since the start
  /// Node of a body, placed at its centre of mass in the parent's frame; nullptr if there is no such body.
  const Ogre::SceneNode* node(const std::string& name) const;

 private:
  struct Look {
    Ogre::MaterialPtr material;
    Ogre::ColourValue color;  ///< colour while no tip is in the body
  };
  struct Part {
    Ogre::SceneNode* node;
    Ogre::Entity* entity;
    std::vector<Look> looks;  ///< one, or for a mesh file one per sub-mesh
  };
  struct Body {
    Ogre::SceneNode* node = nullptr;
    bool movable = false;
    bool named = true;  ///< whether the newest message contains it
    bool highlighted = false, pierced = false;
    std::vector<Part> parts;
  };

  Ogre::Entity* make_entity(const ShapeDescription& shape);
  void add_part(const SceneDescription& scene, const ShapeDescription& shape, Body& body);
  static void color(Body& body, bool highlighted, bool pierced);

  Ogre::SceneManager* manager_;
  Ogre::SceneNode* parent_;
  std::map<std::string, Body> bodies_;
  std::vector<Ogre::MeshPtr> meshes_;
  std::size_t built_ = 0;
};

}  // namespace spring_workbench::rviz_plugin
