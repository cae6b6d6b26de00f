#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision_result.h>

#include <memory>
#include <utility>
#include <vector>

#include "side_contacts.h"
#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/geometry/solid_contacts.h"

namespace spring_workbench::collision {

using Triangles = fcl::BVHModel<fcl::OBBRSSd>;

/// Contact of two shapes. FCL says which of their triangles meet, and how far apart they are; its normals and depths
/// come from GJK/EPA, are one point at most and change sign or face from pose to pose. So two boxes are clipped as in
/// mode `dynamic`, spheres are done by closed formulas, a box and a cylinder by their features as there, meshes at the
/// side of a cylinder by their edges, and everything else, cylinders as prisms, by the triangles that meet.
class NarrowPhase {
 public:
  /// Prepares a shape; returns its index.
  std::size_t add(const geometry::Geometry& geometry);

  /// Appends the contacts of shape `own` with shape `other` that are deeper than `tolerance` [m], without `other`'s
  /// index.
  void append_contacts(std::size_t own, const RigidTransform& X_WA, std::size_t other, const RigidTransform& X_WB,
                       double tolerance, std::vector<ContactPoint>& contacts);

  /// How far every point of a shape can certainly go before it is deeper in the other than `tolerance` >= 0 [m]; 0 for
  /// a sphere and a mesh. The whole tolerance is used where depths are exact.
  double free_distance(std::size_t own, const RigidTransform& X_WA, std::size_t other, const RigidTransform& X_WB,
                       double tolerance);

 private:
  struct Solid {
    geometry::Geometry geometry;
    std::shared_ptr<const geometry::Surface> surface;  ///< none for a sphere
    std::unique_ptr<Triangles> triangles;
    std::unique_ptr<TriangleTree> tree;               ///< of a mesh next to a cylinder
    std::unique_ptr<const geometry::Solid> features;  ///< of what meets a sphere or, a box and a cylinder, each other

    template <typename Kind>
    bool is() const {
      return std::holds_alternative<Kind>(geometry);
    }
    void make_surface_and_triangles();
    CylinderSide side_of(const geometry::Cylinder& cylinder, const RigidTransform& X_MC);
  };

  // Made when they are first needed: most resting objects never do.
  const Solid& with_triangles(std::size_t index);
  const geometry::Solid& features(std::size_t index);
  /// Of a box and a cylinder; false if they overlap so deeply that their features do not tell where.
  bool append_features(std::size_t own, const RigidTransform& X_WA, std::size_t other, const RigidTransform& X_WB,
                       double tolerance, std::vector<ContactPoint>& contacts);
  void mesh_and_cylinder(std::size_t mesh, const RigidTransform& X_WM, std::size_t cylinder, const RigidTransform& X_WC,
                         double tolerance, std::vector<ContactPoint>& contacts);
  void surfaces(const Solid& own, const RigidTransform& X_WA, const Solid& other, const RigidTransform& X_WB,
                double tolerance, std::vector<ContactPoint>& contacts);

  std::vector<Solid> solids_;
  /// FCL's result, kept between queries for its memory.
  struct {
    fcl::CollisionResultd result;
    std::vector<std::pair<int, int>> pairs;
  } fcl_;
};

}  // namespace spring_workbench::collision
