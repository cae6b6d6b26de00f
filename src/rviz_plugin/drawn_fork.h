#pragma once

#include <OgreMaterial.h>

#include <string>

#include "spring_workbench/ForkState.h"
#include "spring_workbench/fork_mesh/fork_model.h"

namespace Ogre {
class ManualObject;
class SceneManager;
class SceneNode;
}  // namespace Ogre

namespace spring_workbench::rviz_plugin {

/// A fork in Ogre, drawn from a `ForkState`: the rod's curve from shape, length and strain, and the mesh along it.
class DrawnFork {
 public:
  /// Adds the fork below `parent`, which must outlive it.
  DrawnFork(Ogre::SceneManager* manager, Ogre::SceneNode* parent);
  ~DrawnFork();
  DrawnFork(const DrawnFork&) = delete;
  DrawnFork& operator=(const DrawnFork&) = delete;

  /// Draws the fork. Throws InputError if it cannot be drawn.
  void draw(const ForkState& fork);
  void hide();
  bool visible() const;

 private:
  void deform(const ForkState& fork);
  void fill(unsigned int section, const fork_mesh::ForkModel::Triangles& triangles, const Ogre::MaterialPtr& material,
            bool is_new);

  Ogre::SceneManager* manager_;
  Ogre::ManualObject* object_;
  Ogre::MaterialPtr spring_material_, rigid_material_;
  std::string tool_ = "spring_fork";
  fork_mesh::ForkModel model_;  ///< model of the tool drawn last
  fork_mesh::ForkMesh mesh_;
};

}  // namespace spring_workbench::rviz_plugin
