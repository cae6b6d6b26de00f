#include "narrow_phase.h"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "constants.h"
#include "contact_patches.h"
#include "containment.h"
#include "manifold_reduction.h"
#include "spring_workbench/geometry/box_contacts.h"

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

void append(const std::vector<geometry::BoxContact>& found, std::vector<ContactPoint>& contacts) {
  for (const geometry::BoxContact& c : found) contacts.push_back({0, c.p_W, c.n_W, -c.gap});
}

/// Turns the contacts from `first` on into those of the other body.
void swap_bodies(std::size_t first, std::vector<ContactPoint>& contacts) {
  for (std::size_t i = first; i < contacts.size(); ++i) {
    contacts[i].p_W -= contacts[i].depth * contacts[i].n_W;
    contacts[i].n_W = -contacts[i].n_W;
  }
}

bool are_box_and_cylinder(const geometry::Geometry& a, const geometry::Geometry& b) {
  const auto is_so = [](const geometry::Geometry& box, const geometry::Geometry& cylinder) {
    return std::holds_alternative<geometry::Box>(box) && std::holds_alternative<geometry::Cylinder>(cylinder);
  };
  return is_so(a, b) || is_so(b, a);
}

}  // namespace

void NarrowPhase::Solid::make_surface_and_triangles() {
  surface = geometry::make_surface(geometry);
  if (surface) triangles = make_triangles(*surface->mesh);
}

CylinderSide NarrowPhase::Solid::side_of(const geometry::Cylinder& cylinder, const RigidTransform& X_MC) {
  if (!tree) tree = make_tree(*surface);
  return CylinderSide(*surface, *tree, cylinder, X_MC);
}

std::size_t NarrowPhase::add(const geometry::Geometry& geometry) {
  solids_.push_back({geometry, nullptr, nullptr, nullptr, nullptr});
  if (std::holds_alternative<geometry::MeshPtr>(geometry)) solids_.back().make_surface_and_triangles();
  return solids_.size() - 1;
}

void NarrowPhase::append_contacts(std::size_t own_index, const RigidTransform& X_WA, std::size_t other_index,
                                  const RigidTransform& X_WB, double tolerance, std::vector<ContactPoint>& contacts) {
  const Solid &own = solids_[own_index], &other = solids_[other_index];
  const std::size_t first = contacts.size();
  if (own.is<geometry::Sphere>() || other.is<geometry::Sphere>()) {
    append(geometry::solid_contacts(features(own_index), X_WA, features(other_index), X_WB, -tolerance, 0.0), contacts);
  } else if (own.is<geometry::Box>() && other.is<geometry::Box>()) {
    const auto box = [](const Solid& solid, const RigidTransform& X_WS) {
      return geometry::OutlineBox{X_WS, 0.5 * std::get<geometry::Box>(solid.geometry).size, true};
    };
    append(geometry::box_contacts(box(own, X_WA), box(other, X_WB), -tolerance), contacts);
  } else if (are_box_and_cylinder(own.geometry, other.geometry) &&
             append_features(own_index, X_WA, other_index, X_WB, tolerance, contacts)) {
    return;
  } else if (own.is<geometry::MeshPtr>() && other.is<geometry::Cylinder>()) {
    mesh_and_cylinder(own_index, X_WA, other_index, X_WB, tolerance, contacts);
  } else if (own.is<geometry::Cylinder>() && other.is<geometry::MeshPtr>()) {
    mesh_and_cylinder(other_index, X_WB, own_index, X_WA, tolerance, contacts);
    swap_bodies(first, contacts);
  } else {
    surfaces(with_triangles(own_index), X_WA, with_triangles(other_index), X_WB, tolerance, contacts);
  }
}

bool NarrowPhase::append_features(std::size_t own, const RigidTransform& X_WA, std::size_t other,
                                  const RigidTransform& X_WB, double tolerance, std::vector<ContactPoint>& contacts) {
  const geometry::Solid &a = features(own), &b = features(other);
  const bool overlap = geometry::overlap(a, X_WA, b, X_WB);
  if (!overlap && tolerance >= 0.0) return true;
  const std::size_t first = contacts.size();
  append(geometry::solid_contacts(a, X_WA, b, X_WB, std::max(0.0, -tolerance), deepest_of_features), contacts);
  const auto from = contacts.begin() + static_cast<std::ptrdiff_t>(first);
  const bool touch = std::any_of(from, contacts.end(), [](const ContactPoint& c) { return c.depth > 0.0; });
  // Features behind each other's planes may pass beside a corner.
  const auto is_none = [&](const ContactPoint& c) { return !(c.depth > tolerance) || (c.depth > 0.0 && !overlap); };
  contacts.erase(std::remove_if(from, contacts.end(), is_none), contacts.end());
  reduce_manifold(first, contacts);
  return touch || !overlap;
}

const geometry::Solid& NarrowPhase::features(std::size_t index) {
  Solid& solid = solids_[index];
  if (!solid.features) solid.features = std::make_unique<const geometry::Solid>(solid.geometry);
  return *solid.features;
}

const NarrowPhase::Solid& NarrowPhase::with_triangles(std::size_t index) {
  Solid& solid = solids_[index];
  if (!solid.triangles) solid.make_surface_and_triangles();
  return solid;
}

double NarrowPhase::free_distance(std::size_t own, const RigidTransform& X_WA, std::size_t other,
                                  const RigidTransform& X_WB, double tolerance) {
  if (solids_[own].is<geometry::Sphere>() || solids_[other].is<geometry::Sphere>()) {
    if (solids_[own].is<geometry::MeshPtr>() || solids_[other].is<geometry::MeshPtr>()) return 0.0;
    std::vector<ContactPoint> nearest;
    append_contacts(own, X_WA, other, X_WB, -std::numeric_limits<double>::max(), nearest);
    return std::max(0.0, tolerance - nearest.front().depth);
  }
  double rounded_off = 0.0, side_distance = 0.0;
  if (solids_[own].is<geometry::Cylinder>() && solids_[other].is<geometry::MeshPtr>())
    return free_distance(other, X_WB, own, X_WA, tolerance);
  if (solids_[own].is<geometry::MeshPtr>() && solids_[other].is<geometry::Cylinder>()) {
    const geometry::Cylinder& cylinder = std::get<geometry::Cylinder>(solids_[other].geometry);
    const CylinderSide side = solids_[own].side_of(cylinder, X_WA.inverse() * X_WB);
    side_distance = std::max(0.0, tolerance + side.gap());
    if (side.is_between_ends()) return side_distance;
    rounded_off = with_triangles(other).surface->rounded_off;
  }
  if (are_box_and_cylinder(solids_[own].geometry, solids_[other].geometry)) {
    const std::size_t cylinder = solids_[own].is<geometry::Cylinder>() ? own : other;
    rounded_off = with_triangles(cylinder).surface->rounded_off;
  }
  fcl::DistanceResultd result;
  const Triangles* a = with_triangles(own).triangles.get();
  const Triangles* b = with_triangles(other).triangles.get();
  return std::max(side_distance, fcl::distance(a, X_WA, b, X_WB, fcl::DistanceRequestd(), result) - rounded_off);
}

void NarrowPhase::mesh_and_cylinder(std::size_t mesh, const RigidTransform& X_WM, std::size_t cylinder,
                                    const RigidTransform& X_WC, double tolerance, std::vector<ContactPoint>& contacts) {
  const std::size_t first = contacts.size();
  const geometry::Geometry& round = solids_[cylinder].geometry;
  const CylinderSide side = solids_[mesh].side_of(std::get<geometry::Cylinder>(round), X_WM.inverse() * X_WC);
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
  swap_bodies(first, contacts);
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
  swap_bodies(first, contacts);
}

}  // namespace spring_workbench::collision
