#pragma once

#include <vector>

#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::bodies {

/// Bounding spheres of the bodies of a scene: a fast test that rejects most pairs that cannot touch.
class Surroundings {
 public:
  explicit Surroundings(const scene::Scene& scene) {
    for (const scene::Body& body : scene.bodies) radii_.push_back(2.0 * geometry::bounding_radius(body.collision));
  }
  /// Whether `body`, an index in the scene, may come within reach of a point that is `away_W` from its origin.
  bool may_contain(std::size_t body, const Vector3d& away_W) const {
    return away_W.squaredNorm() <= radii_[body] * radii_[body];
  }

 private:
  std::vector<double> radii_;  ///< twice what is needed, so that rounding does not matter [m]
};

}  // namespace spring_workbench::bodies
