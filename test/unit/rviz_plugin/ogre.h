#pragma once

#include <OgreMaterialManager.h>
#include <OgreMeshManager.h>
#include <OgreRoot.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <gtest/gtest.h>
#include <rviz/ogre_helpers/render_system.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace spring_workbench::rviz_plugin {

/// The renderer of rviz on a virtual display, which exits with this program. Skips if Xvfb is missing.
class Ogre3d : public testing::Test {
 protected:
  using Counts = std::array<std::size_t, 4>;

  static bool has_display() {
    static const bool found = [] {
      FILE* server = popen("Xvfb -displayfd 1 -terminate -screen 0 64x64x24 +extension GLX 2>/dev/null", "r");
      char number[16] = "";
      if (server == nullptr || std::fgets(number, sizeof number, server) == nullptr) return false;
      setenv("DISPLAY", (":" + std::to_string(std::atoi(number))).c_str(), 1);
      setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
      return true;
    }();
    return found;
  }

  void SetUp() override {
    if (!has_display()) GTEST_SKIP() << "rviz: Xvfb is not installed";
    rviz::RenderSystem::disableAntiAliasing();
    manager_ = rviz::RenderSystem::get()->root()->createSceneManager("DefaultSceneManager");
    parent_ = manager_->getRootSceneNode()->createChildSceneNode();
  }
  void TearDown() override {
    if (manager_ != nullptr) rviz::RenderSystem::get()->root()->destroySceneManager(manager_);
  }

  static std::size_t count(Ogre::ResourceManager& resources) {
    std::size_t found = 0;
    for (auto i = resources.getResourceIterator(); i.hasMoreElements(); i.moveNext()) ++found;
    return found;
  }
  /// What there is of materials, meshes, entities, and nodes below the parent.
  Counts counts() {
    std::size_t nodes = 0;
    for (unsigned short i = 0; i < parent_->numChildren(); ++i) nodes += 1 + parent_->getChild(i)->numChildren();
    return {count(Ogre::MaterialManager::getSingleton()), count(Ogre::MeshManager::getSingleton()),
            manager_->getMovableObjects("Entity").size(), nodes};
  }

  Ogre::SceneManager* manager_ = nullptr;
  Ogre::SceneNode* parent_ = nullptr;
};

}  // namespace spring_workbench::rviz_plugin
