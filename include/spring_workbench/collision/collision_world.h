#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::collision {

/// Point where a body touches or enters another.
struct ContactPoint {
  std::size_t other = 0;             ///< index of the other body in the scene, or `CollisionWorld::bench`
  Vector3d p_W = Vector3d::Zero();   ///< on the surface of the other body, in world [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit normal, from the other body towards this one
  double depth = 0.0;                ///< depth of this body in the other along `n_W` [m]; > 0 is penetration
};

/// Depth up to which a body may penetrate others without counting as touching them [m]: one depth for all of them,
/// except for those that yield.
class Tolerance {
 public:
  Tolerance(double depth) : depth_(depth) {}  // NOLINT(google-explicit-constructor): usually one number for all
  /// Sets a separate depth for one body, by its index.
  void set(std::size_t other, double depth) { of_.emplace_back(other, depth); }
  /// Raises the depth for all bodies without a separate depth to at least this one.
  void raise(double depth) { depth_ = std::max(depth_, depth); }
  double depth() const { return depth_; }  ///< in all that have no depth of their own
  double in(std::size_t other) const {
    for (const auto& [body, depth] : of_) {
      if (body == other) return depth;
    }
    return depth_;
  }

 private:
  double depth_;
  std::vector<std::pair<std::size_t, double>> of_;
};

/// Result of a sweep: how far a body may move from one pose to another before it touches something.
struct SweepResult {
  bool hit = false;
  double free_fraction = 1.0;      ///< 0 … 1: the largest fraction found free
  double touching_fraction = 1.0;  ///< the smallest fraction found touching; contacts are looked up here
};

/// Finds contacts between the bodies of a scene, in given poses or on a path. It knows shapes and poses, but no forces
/// and no time, and uses FCL (in the .cpp only). Bodies are numbered as in the scene; the bench is the half-space below
/// `scene.bench_height`. Not copyable; only one thread may use it at a time. The functions are virtual so that code
/// that gets its world from `open_collision_world` (contact/contact_engines.h) need not link against FCL; code that
/// constructs one directly must.
class CollisionWorld {
 public:
  static constexpr std::size_t bench = static_cast<std::size_t>(-1);

  explicit CollisionWorld(const scene::Scene& scene);
  virtual ~CollisionWorld();
  CollisionWorld(CollisionWorld&&) noexcept;
  CollisionWorld& operator=(CollisionWorld&&) noexcept;

  /// Places a body. All bodies start at the scene's poses.
  virtual void set_pose(std::size_t body, const RigidTransform& X_WO);

  /// Broadphase: returns whether anything else, including the bench, may come within `margin` [m] of the path of the
  /// body from `X0_WO` to `X1_WO`. It may return a false positive but never a false negative; the rotation in
  /// between is covered.
  virtual bool may_touch(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                         double margin) const;

  /// Returns the bodies, including the bench, whose bounding boxes reach into `box_W`, in the order of their indices.
  virtual std::vector<std::size_t> near(const Eigen::AlignedBox3d& box_W) const;

  /// Returns whether the body, placed at `X_WO`, penetrates another body or the bench by more than `tolerance`.
  virtual bool touches(std::size_t body, const RigidTransform& X_WO, const Tolerance& tolerance) const;

  /// Appends to `contacts` the contact points of the body, placed at `X_WO`, that are deeper than `tolerance`. For flat
  /// neighbours such as the bench, `tolerance` may be negative, which also gives points that are about to touch. A
  /// flush box on a plane or on a box gives points that span the common face.
  virtual void find_contacts(std::size_t body, const RigidTransform& X_WO, const Tolerance& tolerance,
                             std::vector<ContactPoint>& contacts) const;

  /// Searches the whole path from `X0_WO` to `X1_WO` (straight in position, constant axis in rotation) for the first
  /// contact, as in section 5 of the paper. It advances as far as the gaps guarantee that nothing is touched or, if
  /// there are no gaps, by steps in which no point of the body moves further than `resolution` [m]. In the first step
  /// that touches, `levels` bisections find the free and the touching fraction; with 0 levels, conservative advancement
  /// (Mirtich 1996) finds the time of impact.
  virtual SweepResult sweep(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                            const Tolerance& tolerance, double resolution, int levels) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spring_workbench::collision
