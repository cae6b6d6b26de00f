#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>

#include <string>

namespace spring_workbench::rviz_plugin {

/// A name that no other resource of Ogre has.
std::string unique_name(const std::string& kind);

/// A material of its own, lit from both sides, as rviz' markers are; whoever made it removes it.
Ogre::MaterialPtr make_material();
void set_color(const Ogre::ColourValue& color, const Ogre::MaterialPtr& material);
void remove_material(const Ogre::MaterialPtr& material);

}  // namespace spring_workbench::rviz_plugin
