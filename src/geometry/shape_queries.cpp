#include "spring_workbench/geometry/shape_queries.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench::geometry {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

VolumeProperties box_properties(const Vector3d& size) {
  const double volume = size.prod();
  const Vector3d second = size.cwiseAbs2() * (volume / 12.0);  // ∫ x², ∫ y², ∫ z²
  const Vector3d inertia(second.y() + second.z(), second.x() + second.z(), second.x() + second.y());
  return {volume, Vector3d::Zero(), inertia.asDiagonal()};
}

VolumeProperties sphere_properties(double radius) {
  const double volume = 4.0 / 3.0 * M_PI * radius * radius * radius;
  return {volume, Vector3d::Zero(), 0.4 * volume * radius * radius * Matrix3d::Identity()};
}

VolumeProperties cylinder_properties(const Cylinder& c) {
  const double volume = M_PI * c.radius * c.radius * c.length;
  const double across = volume * (3.0 * c.radius * c.radius + c.length * c.length) / 12.0;
  const double along = 0.5 * volume * c.radius * c.radius;
  return {volume, Vector3d::Zero(), Vector3d(across, across, along).asDiagonal()};
}

/// Sums over the signed tetrahedra between the triangles and the centre of the mesh.
VolumeProperties mesh_properties(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : mesh.vertices) box.extend(v);
  const Vector3d middle = box.center();
  double volume = 0.0;
  Vector3d first = Vector3d::Zero();   // ∫ x
  Matrix3d second = Matrix3d::Zero();  // ∫ x xᵀ
  for (const Eigen::Vector3i& t : mesh.triangles) {
    Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = mesh.corner(t, k) - middle;
    const double v = corners.determinant() / 6.0;
    const Vector3d sum = corners.rowwise().sum();
    volume += v;
    first += v / 4.0 * sum;
    second += v / 20.0 * (corners * corners.transpose() + sum * sum.transpose());
  }
  if (volume == 0.0) return {0.0, middle, Matrix3d::Zero()};
  const Vector3d centre = first / volume;
  const Matrix3d central = second - volume * centre * centre.transpose();
  return {volume, middle + centre, central.trace() * Matrix3d::Identity() - central};
}

/// Winding number of the mesh around `p`, from the solid angles of its triangles (Van Oosterom and Strackee, 1983).
double winding_number(const TriangleMesh& mesh, const Vector3d& p) {
  double half_angles = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Vector3d a = mesh.corner(t, 0) - p, b = mesh.corner(t, 1) - p, c = mesh.corner(t, 2) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2.0 * M_PI);
}

Eigen::AlignedBox3d box_around(const Vector3d& centre, const Vector3d& half) {
  return Eigen::AlignedBox3d(Vector3d(centre - half), Vector3d(centre + half));
}

double cylinder_reach(const Cylinder& c, const RigidTransform& X) {
  const Vector3d axis = X.linear().col(2);
  const double along = std::abs(X.translation().dot(axis)) + 0.5 * c.length;
  const double across = (X.translation() - X.translation().dot(axis) * axis).norm() + c.radius;
  return std::hypot(along, across);
}

/// Largest distance of a point of the shape, placed at `X`, from the origin.
double reach(const Geometry& geometry, const RigidTransform& X) {
  return std::visit(Overloaded{[&](const Box& b) {
                                 const Vector3d centre = X.linear().transpose() * X.translation();
                                 return (centre.cwiseAbs() + 0.5 * b.size).norm();
                               },
                               [&](const Sphere& s) { return X.translation().norm() + s.radius; },
                               [&](const Cylinder& c) { return cylinder_reach(c, X); },
                               [&](const MeshPtr& m) {
                                 double farthest = 0.0;
                                 for (const Vector3d& v : m->vertices) farthest = std::max(farthest, (X * v).norm());
                                 return farthest;
                               }},
                    geometry);
}

}  // namespace

VolumeProperties volume_properties(const Geometry& geometry) {
  return std::visit(Overloaded{[](const Box& b) { return box_properties(b.size); },
                               [](const Sphere& s) { return sphere_properties(s.radius); },
                               [](const Cylinder& c) { return cylinder_properties(c); },
                               [](const MeshPtr& m) { return mesh_properties(*m); }},
                    geometry);
}

bool contains(const Geometry& geometry, const Vector3d& p_S) {
  return std::visit(Overloaded{[&](const Box& b) { return (p_S.cwiseAbs().array() <= 0.5 * b.size.array()).all(); },
                               [&](const Sphere& s) { return p_S.norm() <= s.radius; },
                               [&](const Cylinder& c) {
                                 return std::hypot(p_S.x(), p_S.y()) <= c.radius && std::abs(p_S.z()) <= 0.5 * c.length;
                               },
                               [&](const MeshPtr& m) { return winding_number(*m, p_S) > 0.5; }},
                    geometry);
}

Eigen::AlignedBox3d bounding_box(const Geometry& geometry, const RigidTransform& X_AS) {
  const Vector3d p = X_AS.translation();
  return std::visit(Overloaded{[&](const Box& b) { return box_around(p, X_AS.linear().cwiseAbs() * (0.5 * b.size)); },
                               [&](const Sphere& s) { return box_around(p, Vector3d::Constant(s.radius)); },
                               [&](const Cylinder& c) {
                                 const Vector3d axis = X_AS.linear().col(2);
                                 const Vector3d rim = (1.0 - axis.array().square()).max(0.0).sqrt().matrix();
                                 return box_around(p, 0.5 * c.length * axis.cwiseAbs() + c.radius * rim);
                               },
                               [&](const MeshPtr& m) {
                                 Eigen::AlignedBox3d box;
                                 for (const Vector3d& v : m->vertices) box.extend(Vector3d(X_AS * v));
                                 return box;
                               }},
                    geometry);
}

Eigen::AlignedBox3d bounding_box(const Eigen::AlignedBox3d& box_B, const RigidTransform& X_AB) {
  return box_around(X_AB * box_B.center(), X_AB.linear().cwiseAbs() * (0.5 * box_B.sizes()));
}

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box, double by) {
  return Eigen::AlignedBox3d(Vector3d(box.min().array() - by), Vector3d(box.max().array() + by));
}

std::array<Vector3d, 8> corners(const Vector3d& half) {
  std::array<Vector3d, 8> all;
  for (unsigned i = 0; i < 8; ++i) {
    all[i] = half.cwiseProduct(Vector3d((i & 1) ? 1.0 : -1.0, (i & 2) ? 1.0 : -1.0, (i & 4) ? 1.0 : -1.0));
  }
  return all;
}

Eigen::AlignedBox3d bounding_box(const std::vector<Shape>& shapes) {
  Eigen::AlignedBox3d box;
  for (const Shape& shape : shapes) box.extend(bounding_box(shape.geometry, shape.X_OS));
  return box;
}

bool contains(const std::vector<Shape>& shapes, const Vector3d& p_O) {
  return std::any_of(shapes.begin(), shapes.end(),
                     [&](const Shape& shape) { return contains(shape.geometry, shape.X_OS.inverse() * p_O); });
}

double bounding_radius(const std::vector<Shape>& shapes) {
  double radius = 0.0;
  for (const Shape& shape : shapes) radius = std::max(radius, reach(shape.geometry, shape.X_OS));
  return radius;
}

}  // namespace spring_workbench::geometry
