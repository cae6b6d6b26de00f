#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <OgreMesh.h>

#include <string>

#include "spring_workbench/MeshDescription.h"

namespace Ogre {
class SceneManager;
}

namespace spring_workbench::rviz_plugin {

// Materials and meshes of Ogre. Whoever makes one removes it.

/// A name that no other resource of Ogre has.
std::string unique_name(const std::string& kind);

/// A material of its own, lit from both sides, as rviz' markers are.
Ogre::MaterialPtr make_material();
void set_color(const Ogre::ColourValue& color, const Ogre::MaterialPtr& material);
void remove_material(const Ogre::MaterialPtr& material);

/// The triangles as a mesh, smooth where neighbours meet at less than the crease angle. Null if there are none.
Ogre::MeshPtr make_mesh(const MeshDescription& mesh, Ogre::SceneManager* manager);
void remove_mesh(const Ogre::MeshPtr& mesh);

}  // namespace spring_workbench::rviz_plugin
