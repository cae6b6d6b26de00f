#include "resources.h"

#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreMeshManager.h>
#include <OgreSceneManager.h>
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

Ogre::MeshPtr make_mesh(const MeshDescription& mesh, const std::vector<Eigen::Vector3f>& normals, std::size_t first,
                        std::size_t last, Ogre::SceneManager* manager) {
  Ogre::ManualObject* object = manager->createManualObject();
  object->estimateVertexCount(last - first);
  object->begin("BaseWhiteNoLighting", Ogre::RenderOperation::OT_TRIANGLE_LIST);
  for (std::size_t corner = first; corner < last; ++corner) {
    const float* p = &mesh.vertices[3 * std::size_t{mesh.triangles[corner]}];
    object->position(p[0], p[1], p[2]);
    object->normal(normals[corner].x(), normals[corner].y(), normals[corner].z());
  }
  object->end();
  const Ogre::MeshPtr result = object->convertToMesh(unique_name("mesh"));
  manager->destroyManualObject(object);
  return result;
}

void remove_mesh(const Ogre::MeshPtr& mesh) {
  if (mesh) Ogre::MeshManager::getSingleton().remove(mesh->getHandle());
}

}  // namespace spring_workbench::rviz_plugin
