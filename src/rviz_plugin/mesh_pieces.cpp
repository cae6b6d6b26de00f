#include "mesh_pieces.h"

#include <algorithm>
#include <utility>

#include "constants.h"
#include "resources.h"
#include "spring_workbench/geometry/corner_normals.h"
#include "spring_workbench/ros/common/subscriptions.h"

namespace spring_workbench::rviz_plugin {

MeshPieces::MeshPieces(Ogre::SceneManager* manager, const SceneDescriptionConstPtr& scene)
    : manager_(manager), scene_(scene), pieces_(scene->meshes.size()) {
  normals_->of_mesh.resize(scene->meshes.size());
  thread_ = std::async(std::launch::async, [normals = normals_, scene] {
    for (std::size_t i = 0; i < scene->meshes.size() && !normals->stop; normals->done = ++i)
      normals->of_mesh[i] = geometry::corner_normals(scene->meshes[i].vertices, scene->meshes[i].triangles);
  });
}

MeshPieces::~MeshPieces() {
  normals_->stop = true;
  ros_common::leave_until_exit(std::move(thread_));
  for (const std::vector<Ogre::MeshPtr>& pieces : pieces_) {
    for (const Ogre::MeshPtr& piece : pieces) remove_mesh(piece);
  }
}

MeshPieces::Progress MeshPieces::make_next(std::size_t mesh) {
  if (normals_->done <= mesh) return Progress::waits;
  std::vector<Eigen::Vector3f>& normals = normals_->of_mesh[mesh];
  const std::size_t first = pieces_[mesh].size() * piece_corners;
  if (first >= normals.size()) return Progress::complete;
  const std::size_t last = std::min(first + piece_corners, normals.size());
  pieces_[mesh].push_back(make_mesh(scene_->meshes[mesh], normals, first, last, manager_));
  return Progress::grows;
}

}  // namespace spring_workbench::rviz_plugin
