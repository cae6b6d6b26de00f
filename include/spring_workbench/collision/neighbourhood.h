#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::collision {

/// Finds which bodies come near each other, by boxes alone: around a body at rest, and around the path of a moving one.
/// It is in the header because the collision library is opened, not linked.
class Neighbourhood {
 public:
  Neighbourhood(const scene::Scene& scene, const CollisionWorld& standing, double margin)
      : standing_(standing), margin_(margin) {
    for (const scene::Body& body : scene.bodies) {
      extents_.push_back({geometry::bounding_box(body.collision), geometry::bounding_radius(body.collision)});
    }
  }

  /// Removes all moving bodies.
  void clear() { moving_.clear(); }
  void add_moving(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO) {
    if (!extents_[body].box_O.isEmpty()) moving_.push_back({body, X0_WO, X1_WO});
  }

  /// Returns a box around a body on its path, with the margin.
  Eigen::AlignedBox3d box(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO) const {
    const Extent& extent = extents_[body];
    const Eigen::AlignedBox3d ends =
        geometry::bounding_box(extent.box_O, X0_WO).merged(geometry::bounding_box(extent.box_O, X1_WO));
    const double angle = std::min(math::turn_between(X0_WO, X1_WO).norm(), 2.0);
    return geometry::grown(ends, extent.radius * angle + margin_);
  }
  /// Returns the bodies at rest in the box, the bench included.
  std::vector<std::size_t> standing(const Eigen::AlignedBox3d& box_W) const { return standing_.near(box_W); }
  /// Returns the bodies that are in the box or enter it, in the order of the scene.
  std::vector<std::size_t> inside(const Eigen::AlignedBox3d& box_W) const {
    std::vector<std::size_t> found = standing(box_W);
    for (const Moving& m : moving_) {
      if (box(m.body, m.X0_WO, m.X1_WO).intersects(box_W)) found.push_back(m.body);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  struct Extent {
    Eigen::AlignedBox3d box_O;
    double radius;
  };
  struct Moving {
    std::size_t body;
    RigidTransform X0_WO, X1_WO;
  };
  const CollisionWorld& standing_;
  double margin_;
  std::vector<Extent> extents_;
  std::vector<Moving> moving_;
};

}  // namespace spring_workbench::collision
