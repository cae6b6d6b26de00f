#include <OgreHardwareVertexBuffer.h>
#include <OgreSubMesh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ogre.h"
#include "spring_workbench/geometry/corner_normals.h"
#include "spring_workbench/math/rigid_transform.h"
#include "src/rviz_plugin/resources.h"

namespace spring_workbench::rviz_plugin::mesh_test {
namespace {

class Meshes : public Ogre3d {
 protected:
  /// Of the corners, three for each triangle.
  std::vector<Vector3d> normals_of(const MeshDescription& description) {
    const Ogre::MeshPtr mesh =
        make_mesh(description, geometry::corner_normals(description.vertices, description.triangles), 0,
                  description.triangles.size(), manager_);
    const Ogre::VertexData* data = mesh->getSubMesh(0)->vertexData;
    const Ogre::VertexElement* normal = data->vertexDeclaration->findElementBySemantic(Ogre::VES_NORMAL);
    const auto buffer = data->vertexBufferBinding->getBuffer(normal->getSource());
    auto* bytes = static_cast<unsigned char*>(buffer->lock(Ogre::HardwareBuffer::HBL_READ_ONLY));
    std::vector<Vector3d> result;
    for (std::size_t i = 0; i < data->vertexCount; ++i) {
      float* n = nullptr;
      normal->baseVertexPointerToElement(bytes + i * buffer->getVertexSize(), &n);
      result.emplace_back(n[0], n[1], n[2]);
    }
    buffer->unlock();
    remove_mesh(mesh);
    return result;
  }
};

/// Two triangles that share an edge and are folded by this angle [rad].
MeshDescription fold(double angle) {
  MeshDescription mesh;
  const auto y = static_cast<float>(-std::cos(angle)), z = static_cast<float>(std::sin(angle));
  mesh.vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, y, z};
  mesh.triangles = {0, 1, 2, 1, 0, 3};
  return mesh;
}

/// A flat cone of this many sides, its tip first.
MeshDescription cone(int sides) {
  MeshDescription mesh;
  mesh.vertices = {0.0F, 0.0F, 0.3F};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * M_PI * i / sides;
    mesh.vertices.insert(mesh.vertices.end(),
                         {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F});
    mesh.triangles.insert(mesh.triangles.end(),
                          {0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % sides)});
  }
  return mesh;
}

TEST_F(Meshes, AreSmoothBelowTheCrease) {
  for (const double degrees : {10.0, 30.0, 60.0, 90.0}) {
    const std::vector<Vector3d> normals = normals_of(fold(degrees * M_PI / 180.0));
    ASSERT_EQ(normals.size(), 6u);
    const double between = std::acos(std::min(1.0, normals[0].dot(normals[2]))) * 180.0 / M_PI;
    EXPECT_NEAR(between, degrees < 45.0 ? 0.5 * degrees : 0.0, 0.1) << degrees;  // at the edge, and away from it
  }
  EXPECT_NEAR(normals_of(cone(12))[0].z(), 1.0, 1e-6);
  EXPECT_NEAR(normals_of(cone(100))[0].z(), 1.0 / std::sqrt(1.09), 1e-3);  // its side's own
}

}  // namespace
}  // namespace spring_workbench::rviz_plugin::mesh_test
