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

/// How deep the bodies of a scene are in each other, from their shapes alone: nothing here is shared with the contact
/// engines. Two boxes: the shortest way that separates them. Spheres: exact. Anything else: the deepest point of one's
/// edges below the other's surface, of both ways round; a cylinder's edges are lines 0.5° apart and both rims.
class PairDepth {
 public:
  explicit PairDepth(const scene::Scene& scene);

  /// Of all pairs of which one is movable, and of the movable ones with the bench. `X_WO`: of all bodies, as in the
  /// scene.
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
