#include "material.h"

#include <OgreMaterialManager.h>
#include <OgreTechnique.h>

namespace spring_workbench::rviz_plugin {

std::string unique_name(const std::string& kind) {
  static unsigned long count = 0;
  return "spring_workbench/" + kind + "/" + std::to_string(count++);
}

Ogre::MaterialPtr make_material() {
  const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      unique_name("material"), Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material->setReceiveShadows(false);
  material->getTechnique(0)->setLightingEnabled(true);
  material->setCullingMode(Ogre::CULL_NONE);
  return material;
}

void set_color(const Ogre::ColourValue& color, const Ogre::MaterialPtr& material) {
  const bool solid = color.a >= 1.0F;
  material->setAmbient(color * 0.5F);
  material->setDiffuse(color);
  material->setSceneBlending(solid ? Ogre::SBT_REPLACE : Ogre::SBT_TRANSPARENT_ALPHA);
  material->setDepthWriteEnabled(solid);
}

void remove_material(const Ogre::MaterialPtr& material) {
  if (material) Ogre::MaterialManager::getSingleton().remove(material->getHandle());
}

}  // namespace spring_workbench::rviz_plugin
