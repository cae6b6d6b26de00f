#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision_result.h>

#include <memory>
#include <utility>
#include <vector>

#include "side_contacts.h"
#include "spring_workbench/collision/collision_world.h"

namespace spring_workbench::collision {

using Triangles = fcl::BVHModel<fcl::OBBRSSd>;

/// Contact of two shapes. FCL says which shapes and which of their triangles meet. Where, how deep and in which
/// direction is taken from it for two boxes only (held against the separating axis theorem in the tests); elsewhere its
/// normals and depths come from GJK/EPA, are one point at most and change sign or face from pose to pose. So spheres
/// are done by closed formulas, meshes at the side of a cylinder by their edges, and everything else, cylinders as
/// prisms, by the triangles that meet.
class NarrowPhase {
 public:
  /// Prepares a shape; returns its index.
  std::size_t add(const geometry::Geometry& geometry);

  /// Appends the contacts of shape `own` with shape `other` that are deeper than `tolerance` [m], without `other`'s
  /// index.
  void append_contacts(std::size_t own, const RigidTransform& X_WA, std::size_t other, const RigidTransform& X_WB,
                       double tolerance, std::vector<ContactPoint>& contacts);

  /// How far every point of a shape may surely go before it is deeper in the other than `tolerance` >= 0 [m]; 0 for a
  /// sphere and a mesh. The whole tolerance is used where depths are exact.
  double clear_way(std::size_t own, const RigidTransform& X_WA, std::size_t other, const RigidTransform& X_WB,
                   double tolerance);

 private:
  struct Solid {
    geometry::Geometry geometry;
    std::shared_ptr<const geometry::Surface> surface;  ///< none for a sphere
    std::unique_ptr<Triangles> triangles;
    std::unique_ptr<TriangleTree> tree;  ///< of a mesh beside a cylinder

    template <typename Kind>
    bool is() const {
      return std::holds_alternative<Kind>(geometry);
    }
    void make_surface_and_triangles();
    BesideCylinder beside(const geometry::Cylinder& cylinder, const RigidTransform& X_MC);
  };

  /// Those of boxes and cylinders are made when they are first needed: most resting objects never do.
  const Solid& with_triangles(std::size_t index);
  void sphere_and(const Solid& sphere, const RigidTransform& X_WS, const Solid& other, const RigidTransform& X_WB,
                  double tolerance, std::vector<ContactPoint>& contacts);
  void boxes(const Solid& own, const RigidTransform& X_WA, const Solid& other, const RigidTransform& X_WB,
             double tolerance, std::vector<ContactPoint>& contacts);
  void mesh_and_cylinder(std::size_t mesh, const RigidTransform& X_WM, std::size_t cylinder, const RigidTransform& X_WC,
                         double tolerance, std::vector<ContactPoint>& contacts);
  void surfaces(const Solid& own, const RigidTransform& X_WA, const Solid& other, const RigidTransform& X_WB,
                double tolerance, std::vector<ContactPoint>& contacts);

  std::vector<Solid> solids_;
  /// FCL's answer, kept between queries for its memory.
  struct {
    fcl::CollisionResultd result;
    std::vector<int> touched;
    std::vector<std::pair<int, int>> pairs;
  } fcl_;
};

}  // namespace spring_workbench::collision
