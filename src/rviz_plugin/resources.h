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

// Materials and meshes of Ogre. The caller removes what it has made.

/// A name that is unique among the resources of Ogre.
std::string unique_name(const std::string& kind);

/// A new material, lit from both sides like the markers of rviz.
Ogre::MaterialPtr make_material();
void set_color(const Ogre::ColourValue& color, const Ogre::MaterialPtr& material);
void remove_material(const Ogre::MaterialPtr& material);

/// A mesh of the triangles, smooth across edges below the crease angle. Null if there are no triangles.
Ogre::MeshPtr make_mesh(const MeshDescription& mesh, Ogre::SceneManager* manager);
void remove_mesh(const Ogre::MeshPtr& mesh);

}  // namespace spring_workbench::rviz_plugin
