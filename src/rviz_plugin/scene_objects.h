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

/// The bodies of a scene in Ogre: built once from their description, then only moved and coloured. Frees all that it
/// made.
class SceneObjects {
 public:
  /// Below `parent`, which outlives it.
  SceneObjects(Ogre::SceneManager* manager, Ogre::SceneNode* parent);
  ~SceneObjects();
  SceneObjects(const SceneObjects&) = delete;
  SceneObjects& operator=(const SceneObjects&) = delete;

  /// Builds these bodies in place of the present ones. Fixed bodies are shown, movable ones from their first pose on.
  /// Throws InputError, and changes nothing, for what cannot be drawn.
  void describe(const SceneDescription& scene);
  /// Moves the movable bodies; one that the message does not name is hidden, a name that is not described is ignored.
  /// Throws InputError, and changes nothing, where a pose is none.
  void place(const ObjectStates& objects);
  /// Removes all.
  void clear();

  std::size_t bodies() const { return bodies_.size(); }
  std::size_t built() const { return built_; }  ///< shapes, since the start
  /// In the parent's frame, the body's at its centre of mass; nullptr: no such body.
  const Ogre::SceneNode* node(const std::string& name) const;

 private:
  struct Look {
    Ogre::MaterialPtr material;
    Ogre::ColourValue color;  ///< if nothing is in it
  };
  struct Part {
    Ogre::SceneNode* node;
    Ogre::Entity* entity;
    std::vector<Look> looks;  ///< one, or of a mesh file one per sub-mesh
  };
  struct Body {
    Ogre::SceneNode* node = nullptr;
    bool movable = false;
    bool named = true;  ///< by the newest message
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
