#pragma once

#include <Eigen/StdVector>
#include <array>
#include <memory>
#include <optional>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "spring_workbench/geometry/box_contacts.h"

namespace spring_workbench::geometry {

/// Bounding-box tree over the parts of a solid, by their indices; no tree if there are no parts.
struct PartTree {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::unique_ptr<const Eigen::KdBVH<double, 3, int>> tree;
  void build();  ///< from `boxes`
  /// Returns the parts whose boxes come into a box.
  std::vector<std::size_t> inside(const Eigen::AlignedBox3d& box) const;
};

/// The features of a shape that another solid can touch, in the shape's frame: corners, faces, and convex edges
/// (neither seams within a flat face nor grooves) of a box or a closed mesh. A cylinder's side, ends and rims are
/// exact, as a sphere is, which has none of these; only against another cylinder, its rims have the edges of a prism.
struct Solid {
  struct Face {
    std::array<Vector3d, 3> corners;
    Vector3d n;  ///< unit, outward
  };
  struct Edge {
    Vector3d start, along;
    Vector3d into_left, into_right;  ///< unit, perpendicular to the edge, into its two faces
  };
  explicit Solid(const Geometry& of);

  Geometry geometry;
  std::optional<Cylinder> cylinder;
  std::vector<Vector3d> corners;       ///< of a box or a mesh
  std::vector<std::vector<int>> next;  ///< for each corner, the corners that are joined to it by an edge
  std::vector<Face> faces;             ///< of a box or a mesh
  std::vector<Edge> edges;
  PartTree face_tree, edge_tree;
  Eigen::AlignedBox3d extent;
};

/// Support point: the point of a solid that is furthest along a direction.
Vector3d furthest(const Solid& solid, const Vector3d& along_S);

/// Points with which the solid can rest on a plane with the normal `n_S`: its lowest points, also with the plane tilted
/// slightly in each of eight directions.
std::vector<Vector3d> lowest_points(const Solid& solid, const Vector3d& n_S);

/// All contacts of two solids with a gap between −`deepest` and `reach` [m]: corners of either one (of a cylinder: the
/// points with which it can come to rest) against faces of the other, and edges against edges; those of a sphere at any
/// depth. Contacts between the sides of two cylinders are not found.
std::vector<BoxContact> solid_contacts(const Solid& a, const RigidTransform& X_WA, const Solid& b,
                                       const RigidTransform& X_WB, double reach, double deepest);

/// Whether two solids intersect, at any depth.
bool overlap(const Solid& a, const RigidTransform& X_WA, const Solid& b, const RigidTransform& X_WB);

/// Contact of the point `p_S` inside the solid with the surface at which the line from there along `n_S` leaves the
/// solid; none if the exit is not at the distance `depth` [m] to within `within` [m]. Surfaces in between are ignored,
/// so a point that has passed through a thin part is pushed back to where it entered.
std::optional<BoxContact> exit_contact(const Solid& solid, const Vector3d& p_S, const Vector3d& n_S, double depth,
                                       double within);

}  // namespace spring_workbench::geometry
