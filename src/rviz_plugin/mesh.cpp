#include "mesh.h"

#include <OgreManualObject.h>
#include <OgreMeshManager.h>
#include <OgreSceneManager.h>

#include <string>
#include <vector>

#include "constants.h"
#include "material.h"
#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::rviz_plugin {
namespace {

using Eigen::Vector3f;

/// The triangles of a message, by number.
class Triangles {
 public:
  explicit Triangles(const MeshDescription& mesh) : mesh_(mesh), at_vertex_(mesh.vertices.size() / 3) {
    for (std::size_t t = 0; t < count(); ++t) {
      normals_.push_back((point(t, 1) - point(t, 0)).cross(point(t, 2) - point(t, 0)));
      for (std::size_t k = 0; k < 3; ++k) at_vertex_[vertex(t, k)].push_back(t);
    }
  }
  std::size_t count() const { return mesh_.triangles.size() / 3; }
  Vector3f point(std::size_t t, std::size_t k) const { return Vector3f(&mesh_.vertices[3 * vertex(t, k)]); }

  /// Mean normal, by area, of the triangles at this corner that are nearly in one plane with it.
  Vector3f normal(std::size_t t, std::size_t k) const {
    const std::vector<std::size_t>& neighbours = at_vertex_[vertex(t, k)];
    const Vector3f own = normals_[t].normalized();
    if (neighbours.size() > most_smoothed) return own;
    Vector3f sum = Vector3f::Zero();
    for (const std::size_t other : neighbours) {
      if (other == t || own.dot(normals_[other].normalized()) > crease_cosine) sum += normals_[other];
    }
    return sum.normalized();
  }

 private:
  std::size_t vertex(std::size_t t, std::size_t k) const { return mesh_.triangles[3 * t + k]; }

  const MeshDescription& mesh_;
  std::vector<Vector3f> normals_;  ///< as long as twice the areas
  std::vector<std::vector<std::size_t>> at_vertex_;
};

Ogre::Vector3 to_ogre(const Vector3f& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

Ogre::MeshPtr make_mesh(const MeshDescription& mesh, Ogre::SceneManager* manager) {
  const Triangles triangles(mesh);
  if (triangles.count() == 0) return Ogre::MeshPtr();
  Ogre::ManualObject* object = manager->createManualObject();
  object->estimateVertexCount(3 * triangles.count());
  object->begin("BaseWhiteNoLighting", Ogre::RenderOperation::OT_TRIANGLE_LIST);
  for (std::size_t t = 0; t < triangles.count(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      object->position(to_ogre(triangles.point(t, k)));
      object->normal(to_ogre(triangles.normal(t, k)));
    }
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
