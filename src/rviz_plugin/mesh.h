#pragma once

#include <OgreMesh.h>

#include "spring_workbench/MeshDescription.h"

namespace Ogre {
class SceneManager;
}

namespace spring_workbench::rviz_plugin {

/// The triangles as a mesh of Ogre, smooth where neighbours meet at less than the crease angle. Null if there are none;
/// whoever made it removes it.
Ogre::MeshPtr make_mesh(const MeshDescription& mesh, Ogre::SceneManager* manager);
void remove_mesh(const Ogre::MeshPtr& mesh);

}  // namespace spring_workbench::rviz_plugin
