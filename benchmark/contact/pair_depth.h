#pragma once

#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// The deepest pair of a scene.
struct DeepestPair {
  double depth = 0.0;         ///< [m]; 0: none overlap
  std::string first, second;  ///< names; "workbench" for the bench
};

/// Penetration depth between the bodies of a scene, computed from their shapes without any code of the contact engines.
/// Two boxes: the shortest separating displacement. Spheres: exact. Other pairs: the deepest point of the edges of
/// either one below the surface of the other; a cylinder's edges are lines 0.5° apart and both rims.
class PairDepth {
 public:
  explicit PairDepth(const scene::Scene& scene);

  /// The deepest of all pairs with a movable body, including the bench. `X_WO`: poses of all bodies, in the scene's
  /// order.
  DeepestPair deepest(const std::vector<RigidTransform>& X_WO) const;

 private:
  struct Solid {
    std::size_t body = 0;
    const geometry::Shape* shape = nullptr;
    std::vector<Vector3d> points;  ///< ends of the edges, in the shape's frame
    std::vector<std::pair<std::size_t, std::size_t>> edges;
  };
  struct Placed {
    const Solid* solid = nullptr;
    RigidTransform X_WS = RigidTransform::Identity();
    Eigen::AlignedBox3d box_W;
  };
  static Solid solid_of(std::size_t body, const geometry::Shape& shape);
  static double depth_between(const Placed& a, const Placed& b);
  static double depth_of_edges(const Placed& of, const Placed& in);
  static double depth_below(const Placed& of, double height);

  const scene::Scene& scene_;
  std::vector<Solid> solids_;
};

}  // namespace spring_workbench::benchmark
