#pragma once

#ifndef Q_MOC_RUN
#include <OgreMaterial.h>
#include <OgreMesh.h>

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mesh_pieces.h"
#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/SceneDescription.h"
#endif

namespace Ogre {
class Entity;
class SceneManager;
class SceneNode;
}  // namespace Ogre

namespace spring_workbench::rviz_plugin {

/// The bodies of a scene in Ogre: built once from their description, in parts, then only moved and coloured. Frees all
/// its resources.
class SceneObjects {
 public:
  /// Adds the bodies below `parent`, which must outlive it.
  SceneObjects(Ogre::SceneManager* manager, Ogre::SceneNode* parent);
  ~SceneObjects();
  SceneObjects(const SceneObjects&) = delete;
  SceneObjects& operator=(const SceneObjects&) = delete;

  /// Replaces the current bodies, whose shapes `build` makes. Fixed bodies are shown at once, movable ones from their
  /// first pose on. Throws InputError, and changes nothing, if the scene cannot be drawn.
  void describe(const SceneDescriptionConstPtr& scene);
  /// Builds shapes for `time` [s], but one or a piece of one at least, unless the normals of all that are left are
  /// still being computed. Returns whether all are there. A mesh file that rviz reads takes the time that it takes.
  bool build(double time);
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
    std::vector<Ogre::Entity*> entities;
    std::vector<Look> looks;  ///< one, or for a mesh file one per sub-mesh
  };
  struct Body {
    Ogre::SceneNode* node = nullptr;
    bool movable = false;
    bool named = true;  ///< whether the newest message contains it
    bool highlighted = false, pierced = false;
    std::vector<Part> parts;
  };

  struct Work {
    Body* body;
    const ShapeDescription* shape;
    bool of_file;  ///< whether to try its mesh file
  };

  bool build_next();
  void add_part(const Work& work, const Ogre::MeshPtr& file);
  std::vector<Ogre::Entity*> make_entities(const ShapeDescription& shape);
  static void color(Body& body, bool highlighted, bool pierced);

  Ogre::SceneManager* manager_;
  Ogre::SceneNode* parent_;
  std::map<std::string, Body> bodies_;
  SceneDescriptionConstPtr scene_;
  std::deque<Work> waiting_;  ///< shapes that are not built yet
  std::unique_ptr<MeshPieces> meshes_;
  std::size_t built_ = 0;
};

}  // namespace spring_workbench::rviz_plugin
