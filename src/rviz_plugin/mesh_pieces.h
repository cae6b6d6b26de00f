#pragma once

#include <OgreMesh.h>

#include <Eigen/Core>
#include <atomic>
#include <cstddef>
#include <future>
#include <memory>
#include <vector>

#include "spring_workbench/SceneDescription.h"

namespace Ogre {
class SceneManager;
}

namespace spring_workbench::rviz_plugin {

/// The triangles of a scene's visual shapes as meshes of Ogre, made piece by piece, so that rviz goes on drawing
/// meanwhile. Their normals are computed in the background. Frees all its meshes.
class MeshPieces {
 public:
  enum class Progress { waits, grows, complete };  ///< waits: for the normals

  MeshPieces(Ogre::SceneManager* manager, const SceneDescriptionConstPtr& scene);
  ~MeshPieces();
  MeshPieces(const MeshPieces&) = delete;
  MeshPieces& operator=(const MeshPieces&) = delete;

  /// Makes the next piece of a mesh, if there is one.
  Progress make_next(std::size_t mesh);
  /// The pieces made so far; none if the mesh has no triangles.
  const std::vector<Ogre::MeshPtr>& of(std::size_t mesh) const { return pieces_[mesh]; }

 private:
  struct Normals {
    std::vector<std::vector<Eigen::Vector3f>> of_mesh;
    std::atomic<std::size_t> done{0};  ///< meshes; the thread no longer uses their normals
    std::atomic<bool> stop{false};
  };

  Ogre::SceneManager* manager_;
  SceneDescriptionConstPtr scene_;
  std::vector<std::vector<Ogre::MeshPtr>> pieces_;
  std::shared_ptr<Normals> normals_ = std::make_shared<Normals>();
  std::future<void> thread_;
};

}  // namespace spring_workbench::rviz_plugin
