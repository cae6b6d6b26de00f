#include "side_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::collision {
namespace {

using Eigen::Vector2d;
using Corners = std::array<Vector3d, 3>;  // of a triangle, in the cylinder's frame

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where on the segment from `a` to `b` it is nearest to the z axis: 0 … 1.
double nearest_on_edge(const Vector3d& a, const Vector3d& b) {
  const Vector2d along = (b - a).head<2>();
  const double size = along.squaredNorm();
  return size > 0.0 ? std::clamp(-a.head<2>().dot(along) / size, 0.0, 1.0) : 0.0;
}

bool goes_through(const Corners& c) {
  const double s = cross(c[0].head<2>(), c[1].head<2>());
  const double t = cross(c[1].head<2>(), c[2].head<2>());
  const double u = cross(c[2].head<2>(), c[0].head<2>());
  return (s > 0.0 && t > 0.0 && u > 0.0) || (s < 0.0 && t < 0.0 && u < 0.0);
}

double distance_from_axis(const Corners& c) {
  if (goes_through(c)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& a = c[k];
    const Vector3d& b = c[(k + 1) % 3];
    nearest = std::min(nearest, (a + nearest_on_edge(a, b) * (b - a)).head<2>().norm());
  }
  return nearest;
}

/// The surface as the cylinder's axis sees it.
struct View {
  const geometry::Surface& surface;
  const RigidTransform& X_CM;

  Corners corners(int triangle) const {
    return {X_CM * surface.corner(triangle, 0), X_CM * surface.corner(triangle, 1), X_CM * surface.corner(triangle, 2)};
  }
  /// From the axis to a box around what a box of the tree looks like from along the axis.
  double distance_from_axis(const Eigen::AlignedBox3d& box) const {
    const Vector2d centre = (X_CM * box.center()).head<2>();
    const Vector2d half = X_CM.linear().topRows<2>().cwiseAbs() * (0.5 * box.sizes());
    return (centre.cwiseAbs() - half).cwiseMax(0.0).norm();
  }
};

/// For Eigen's BVMinimize.
struct Nearest {
  using Scalar = double;
  View view;
  double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return view.distance_from_axis(box); }
  double minimumOnObject(int triangle) const { return distance_from_axis(view.corners(triangle)); }
};

/// For Eigen's BVIntersect: the triangles that are nearer to the axis than `reach`.
struct Near {
  View view;
  double reach;
  std::vector<int>& found;
  bool intersectVolume(const Eigen::AlignedBox3d& box) const { return view.distance_from_axis(box) < reach; }
  bool intersectObject(int triangle) {
    if (distance_from_axis(view.corners(triangle)) < reach) found.push_back(triangle);
    return false;
  }
};

}  // namespace

std::unique_ptr<TriangleTree> make_tree(const geometry::Surface& surface) {
  std::vector<int> triangles;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t i = 0; i < surface.normals.size(); ++i) {
    triangles.push_back(static_cast<int>(i));
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 3; ++k) box.extend(surface.corner(triangles.back(), k));
    boxes.push_back(box);
  }
  if (triangles.size() == 1) {  // Eigen's tree has no root for one
    triangles.push_back(triangles[0]);
    boxes.push_back(boxes[0]);
  }
  return std::make_unique<TriangleTree>(triangles.begin(), triangles.end(), boxes.begin(), boxes.end());
}

CylinderSide::CylinderSide(const geometry::Surface& surface, const TriangleTree& tree,
                           const geometry::Cylinder& cylinder, const RigidTransform& X_MC)
    : surface_(surface), tree_(tree), cylinder_(cylinder), X_CM_(X_MC.inverse()) {}

double CylinderSide::gap() const {
  Nearest nearest{{surface_, X_CM_}};
  return Eigen::BVMinimize(tree_, nearest) - cylinder_.radius;
}

bool CylinderSide::is_between_ends() const {
  const Eigen::AlignedBox3d box = tree_.getVolume(tree_.getRootIndex());
  const double half = X_CM_.linear().row(2).cwiseAbs().dot(0.5 * box.sizes());
  return std::abs((X_CM_ * box.center()).z()) + half < 0.5 * cylinder_.length;
}

bool CylinderSide::append_contacts(double tolerance, std::vector<ContactPoint>& contacts) const {
  const View view{surface_, X_CM_};
  std::vector<int> triangles;
  Near near{view, cylinder_.radius - tolerance, triangles};
  Eigen::BVIntersect(tree_, near);
  const std::size_t first = contacts.size();
  const double end = 0.5 * cylinder_.length;
  const RigidTransform X_MC = X_CM_.inverse();
  const auto add = [&](const Vector3d& p) {
    const double across = p.head<2>().norm();
    const double depth = cylinder_.radius - across;
    if (!(depth > tolerance)) return;
    const Vector3d n(p.x() / across, p.y() / across, 0.0);
    contacts.push_back({0, X_MC * Vector3d(p + depth * n), X_MC.linear() * n, depth});
  };
  for (const int t : triangles) {
    const Corners c = view.corners(t);
    const auto [lowest, highest] = std::minmax({c[0].z(), c[1].z(), c[2].z()});
    if (lowest > end || highest < -end) continue;
    if (lowest < -end || highest > end || distance_from_axis(c) < 1e-6 * cylinder_.radius) {
      contacts.resize(first);
      return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (surface_.neighbours[static_cast<std::size_t>(t)][k] > t)
        continue;  // the edge is looked at with the other triangle
      const Vector3d& a = c[k];
      const Vector3d& b = c[(k + 1) % 3];
      const double s = nearest_on_edge(a, b);
      add(a + s * (b - a));
      if (s > 0.0) add(a);
      if (s < 1.0) add(b);
    }
  }
  return true;
}

}  // namespace spring_workbench::collision
