#pragma once

#include <Eigen/Geometry>
#include <Eigen/StdVector>
#include <memory>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/geometry/surface.h"

namespace spring_workbench::collision {

/// The triangles of a surface, by their indices, in a tree of boxes in its frame.
using TriangleTree = Eigen::KdBVH<double, 3, int>;
std::unique_ptr<TriangleTree> make_tree(const geometry::Surface& surface);

/// A mesh next to a cylinder, where the cylinder's ends are not in play: exact, as what comes nearest to the axis of a
/// cylinder is a point of an edge, unless the axis goes through a triangle.
class CylinderSide {
 public:
  /// `X_MC`: the cylinder in the frame of the surface. All are kept by reference.
  CylinderSide(const geometry::Surface& surface, const TriangleTree& tree, const geometry::Cylinder& cylinder,
               const RigidTransform& X_MC);

  /// The gap to the cylinder if it had no ends [m]; negative where an edge is in it, −radius where its axis goes
  /// through a triangle.
  double gap() const;

  /// Appends the contacts deeper than `tolerance` [m] of the mesh as the body with the cylinder as the other, in the
  /// frame of the surface: on each edge the point that is deepest, and corners. False, and then nothing is appended,
  /// where an end of the cylinder may be touched or its axis goes through a triangle.
  bool append_contacts(double tolerance, std::vector<ContactPoint>& contacts) const;

  /// Whether the whole mesh is between the planes of the cylinder's ends.
  bool is_between_ends() const;

 private:
  const geometry::Surface& surface_;
  const TriangleTree& tree_;
  const geometry::Cylinder& cylinder_;
  RigidTransform X_CM_;
};

}  // namespace spring_workbench::collision
