#pragma once

#include <Eigen/StdVector>
#include <array>
#include <memory>
#include <optional>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "spring_workbench/geometry/box_contacts.h"

namespace spring_workbench::geometry {

/// Boxes around parts of a solid, by their indices; none where there are no parts.
struct PartTree {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::unique_ptr<const Eigen::KdBVH<double, 3, int>> tree;
  void build();  ///< from `boxes`
};

/// A box, a cylinder or a closed mesh by what another one can touch: corners, faces, and edges that are neither seams
/// within a face nor grooves. A cylinder has the edges of its rims, as of a prism; its side, its ends and the points of
/// its rims are exact. In the shape's frame.
struct Solid {
  struct Face {
    std::array<Vector3d, 3> corners;
    Vector3d n;  ///< unit, outward
  };
  struct Edge {
    Vector3d start, along;
    Vector3d into_left, into_right;  ///< unit, across the edge, into its two faces
  };
  explicit Solid(const Geometry& of);

  Geometry geometry;
  std::optional<Cylinder> cylinder;
  std::vector<Vector3d> corners;       ///< none of a cylinder
  std::vector<std::vector<int>> next;  ///< to each corner those that edges join with it
  std::vector<Face> faces;             ///< none of a cylinder
  std::vector<Edge> edges;
  PartTree face_tree, edge_tree;
  Eigen::AlignedBox3d extent;
};

/// The point of a solid that lies furthest along a direction.
Vector3d furthest(const Solid& solid, const Vector3d& along_S);

/// Points of the solid with which it may come to lie on a plane with the normal `n_S`: those that lie furthest down,
/// and furthest down with a slope to one of eight sides.
std::vector<Vector3d> lowest_points(const Solid& solid, const Vector3d& n_S);

/// All contacts of two solids with a gap between −`deepest` and `reach` [m]: corners (of a cylinder the points with
/// which it would come to lie) before faces, both ways round, and edges across edges. Of two cylinders: not their sides
/// with each other.
std::vector<BoxContact> solid_contacts(const Solid& a, const RigidTransform& X_WA, const Solid& b,
                                       const RigidTransform& X_WB, double reach, double deepest);

/// Whether two solids have a part in common, however deep.
bool overlap(const Solid& a, const RigidTransform& X_WA, const Solid& b, const RigidTransform& X_WB);

/// The contact of a point inside the solid, in its frame, with the surface where the line from there along `n_S`
/// leaves it; none if that is not after `depth` [m], but for `within`. What is between is not looked at: a point that
/// has gone through a thin part comes back where it went in.
std::optional<BoxContact> way_out(const Solid& solid, const Vector3d& p_S, const Vector3d& n_S, double depth,
                                  double within);

}  // namespace spring_workbench::geometry
