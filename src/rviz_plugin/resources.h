#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <OgreMesh.h>

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

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

/// A mesh of the triangles with the corners from `first` to before `last`, with the normals of all corners.
Ogre::MeshPtr make_mesh(const MeshDescription& mesh, const std::vector<Eigen::Vector3f>& normals, std::size_t first,
                        std::size_t last, Ogre::SceneManager* manager);
void remove_mesh(const Ogre::MeshPtr& mesh);

}  // namespace spring_workbench::rviz_plugin
