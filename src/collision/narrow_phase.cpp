#include "narrow_phase.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "constants.h"
#include "contact_patches.h"
#include "sphere_contacts.h"
#include "swallowed.h"
#include "thin_out.h"

namespace spring_workbench::collision {
namespace {

std::unique_ptr<Triangles> make_triangles(const geometry::TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  auto model = std::make_unique<Triangles>();
  model->beginModel();
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

fcl::CollisionRequestd which_triangles() {
  constexpr std::size_t all = std::numeric_limits<int>::max();
  return fcl::CollisionRequestd(all, false);
}

/// How far from `q` along `n` the box ends, in the box's frame; 0 where `q` is outside already.
double way_out(const geometry::Box& box, const Vector3d& q, const Vector3d& n) {
  double path = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (n[i] == 0.0) continue;
    path = std::min(path, ((n[i] > 0.0 ? 0.5 : -0.5) * box.size[i] - q[i]) / n[i]);
  }
  return std::max(path, 0.0);
}

}  // namespace

void NarrowPhase::Solid::make_surface_and_triangles() {
  surface = geometry::make_surface(geometry);
  if (surface) triangles = make_triangles(*surface->mesh);
}

BesideCylinder NarrowPhase::Solid::beside(const geometry::Cylinder& cylinder, const RigidTransform& X_MC) {
  if (!tree) tree = make_tree(*surface);
  return BesideCylinder(*surface, *tree, cylinder, X_MC);
}

std::size_t NarrowPhase::add(const geometry::Geometry& geometry) {
  solids_.push_back({geometry, nullptr, nullptr, nullptr});
  if (std::holds_alternative<geometry::MeshPtr>(geometry)) solids_.back().make_surface_and_triangles();
  return solids_.size() - 1;
}

void NarrowPhase::append_contacts(std::size_t own_index, const RigidTransform& X_WA, std::size_t other_index,
                                  const RigidTransform& X_WB, double tolerance, std::vector<ContactPoint>& contacts) {
  const Solid &own = solids_[own_index], &other = solids_[other_index];
  const std::size_t first = contacts.size();
  if (own.is<geometry::Sphere>()) {
    sphere_and(own, X_WA, other, X_WB, tolerance, contacts);
  } else if (other.is<geometry::Sphere>()) {
    sphere_and(other, X_WB, own, X_WA, tolerance, contacts);
    turn_round(first, contacts);
  } else if (own.is<geometry::Box>() && other.is<geometry::Box>()) {
    boxes(own, X_WA, other, X_WB, tolerance, contacts);
  } else if (own.is<geometry::MeshPtr>() && other.is<geometry::Cylinder>()) {
    mesh_and_cylinder(own_index, X_WA, other_index, X_WB, tolerance, contacts);
  } else if (own.is<geometry::Cylinder>() && other.is<geometry::MeshPtr>()) {
    mesh_and_cylinder(other_index, X_WB, own_index, X_WA, tolerance, contacts);
    turn_round(first, contacts);
  } else {
    surfaces(with_triangles(own_index), X_WA, with_triangles(other_index), X_WB, tolerance, contacts);
  }
}

const NarrowPhase::Solid& NarrowPhase::with_triangles(std::size_t index) {
  Solid& solid = solids_[index];
  if (!solid.triangles) solid.make_surface_and_triangles();
  return solid;
}

double NarrowPhase::clear_way(std::size_t own, const RigidTransform& X_WA, std::size_t other,
                              const RigidTransform& X_WB, double tolerance) {
  if (solids_[own].is<geometry::Sphere>() || solids_[other].is<geometry::Sphere>()) {
    if (solids_[own].is<geometry::MeshPtr>() || solids_[other].is<geometry::MeshPtr>()) return 0.0;
    std::vector<ContactPoint> nearest;
    append_contacts(own, X_WA, other, X_WB, -std::numeric_limits<double>::max(), nearest);
    return std::max(0.0, tolerance - nearest.front().depth);
  }
  double rounded_off = 0.0, beside = 0.0;
  if (solids_[own].is<geometry::Cylinder>() && solids_[other].is<geometry::MeshPtr>())
    return clear_way(other, X_WB, own, X_WA, tolerance);
  if (solids_[own].is<geometry::MeshPtr>() && solids_[other].is<geometry::Cylinder>()) {
    const geometry::Cylinder& cylinder = std::get<geometry::Cylinder>(solids_[other].geometry);
    const BesideCylinder side = solids_[own].beside(cylinder, X_WA.inverse() * X_WB);
    beside = std::max(0.0, tolerance + side.gap());
    if (side.is_between_ends()) return beside;
    rounded_off = with_triangles(other).surface->rounded_off;
  }
  fcl::DistanceResultd result;
  const Triangles* a = with_triangles(own).triangles.get();
  const Triangles* b = with_triangles(other).triangles.get();
  return std::max(beside, fcl::distance(a, X_WA, b, X_WB, fcl::DistanceRequestd(), result) - rounded_off);
}

void NarrowPhase::mesh_and_cylinder(std::size_t mesh, const RigidTransform& X_WM, std::size_t cylinder,
                                    const RigidTransform& X_WC, double tolerance, std::vector<ContactPoint>& contacts) {
  const std::size_t first = contacts.size();
  const geometry::Geometry& round = solids_[cylinder].geometry;
  const BesideCylinder side = solids_[mesh].beside(std::get<geometry::Cylinder>(round), X_WM.inverse() * X_WC);
  if (!side.append_contacts(std::max(0.0, tolerance), contacts)) {
    surfaces(with_triangles(mesh), X_WM, with_triangles(cylinder), X_WC, tolerance, contacts);
    return;
  }
  for (std::size_t i = first; i < contacts.size(); ++i) {
    contacts[i].p_W = X_WM * contacts[i].p_W;
    contacts[i].n_W = X_WM.linear() * contacts[i].n_W;
  }
  reduce_manifold(first, contacts);
  if (contacts.size() > first) return;
  append_containment(round, X_WC, solids_[mesh].geometry, {*solids_[mesh].surface, X_WM}, tolerance, contacts);
  turn_round(first, contacts);
}

void NarrowPhase::sphere_and(const Solid& sphere, const RigidTransform& X_WS, const Solid& other,
                             const RigidTransform& X_WB, double tolerance, std::vector<ContactPoint>& contacts) {
  const double radius = std::get<geometry::Sphere>(sphere.geometry).radius;
  const Vector3d centre_W = X_WS.translation();
  if (!other.is<geometry::MeshPtr>()) {
    append_sphere_contact(radius, centre_W, other.geometry, X_WB, tolerance, contacts);
    return;
  }
  const fcl::Sphered reached(radius + std::max(0.0, -tolerance));
  fcl_.result.clear();
  fcl::collide(other.triangles.get(), X_WB, &reached, X_WS, which_triangles(), fcl_.result);
  fcl_.touched.clear();
  for (std::size_t i = 0; i < fcl_.result.numContacts(); ++i) {
    fcl_.touched.push_back(static_cast<int>(fcl_.result.getContact(i).b1));
  }
  append_sphere_triangle_contacts(radius, centre_W, *other.surface, X_WB, fcl_.touched, tolerance, contacts);
  if (fcl_.touched.empty()) {
    append_containment(sphere.geometry, X_WS, other.geometry, {*other.surface, X_WB}, tolerance, contacts);
  }
}

/// FCL clips two boxes into up to eight points with one normal. A negative tolerance is met by growing the other box.
void NarrowPhase::boxes(const Solid& own, const RigidTransform& X_WA, const Solid& other, const RigidTransform& X_WB,
                        double tolerance, std::vector<ContactPoint>& contacts) {
  const double grown = std::max(0.0, -tolerance);
  const geometry::Box reached{std::get<geometry::Box>(other.geometry).size + Vector3d::Constant(2.0 * grown)};
  const fcl::Boxd a(std::get<geometry::Box>(own.geometry).size), b(reached.size);
  fcl_.result.clear();
  fcl::collide(&a, X_WA, &b, X_WB, fcl::CollisionRequestd(most_box_points, true), fcl_.result);
  for (std::size_t i = 0; i < fcl_.result.numContacts(); ++i) {
    const fcl::Contactd& contact = fcl_.result.getContact(i);
    const Vector3d n_W = -contact.normal;  // FCL's points from own to other
    const double depth = contact.penetration_depth - grown;
    if (!(depth > tolerance)) continue;
    // FCL's point is in between, and where two edges are nearly parallel it may lie off both.
    const Vector3d half = 0.5 * reached.size;
    const Vector3d p_B = (X_WB.inverse() * contact.pos).cwiseMin(half).cwiseMax(-half);
    const double path = way_out(reached, p_B, X_WB.linear().transpose() * n_W);
    contacts.push_back({0, X_WB * p_B + (path - grown) * n_W, n_W, depth});
  }
}

void NarrowPhase::surfaces(const Solid& own, const RigidTransform& X_WA, const Solid& other, const RigidTransform& X_WB,
                           double tolerance, std::vector<ContactPoint>& contacts) {
  const std::size_t first = contacts.size();
  const PlacedSurface own_surface{*own.surface, X_WA};
  const PlacedSurface other_surface{*other.surface, X_WB};
  fcl_.result.clear();
  fcl::collide(own.triangles.get(), X_WA, other.triangles.get(), X_WB, which_triangles(), fcl_.result);
  if (fcl_.result.isCollision()) {
    fcl_.pairs.clear();
    for (std::size_t i = 0; i < fcl_.result.numContacts(); ++i) {
      const fcl::Contactd& pair = fcl_.result.getContact(i);
      fcl_.pairs.emplace_back(static_cast<int>(pair.b1), static_cast<int>(pair.b2));
    }
    append_surface_contacts(own_surface, other_surface, fcl_.pairs, tolerance, contacts);
    reduce_manifold(first, contacts);
    return;
  }
  append_containment(own.geometry, X_WA, other.geometry, other_surface, tolerance, contacts);
  if (contacts.size() > first) return;
  append_containment(other.geometry, X_WB, own.geometry, own_surface, tolerance, contacts);
  turn_round(first, contacts);
}

}  // namespace spring_workbench::collision
