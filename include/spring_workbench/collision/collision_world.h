#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::collision {

/// A point where a body touches or enters another.
struct ContactPoint {
  std::size_t other = 0;             ///< index of the other body in the scene, or `CollisionWorld::bench`
  Vector3d p_W = Vector3d::Zero();   ///< on the surface of the other body, in world [m]
  Vector3d n_W = Vector3d::UnitZ();  ///< unit normal, from the other body towards this one
  double depth = 0.0;                ///< how far this body is in the other along `n_W` [m]; > 0 is penetration
};

/// How far a body may move from one pose to another before it touches something.
struct SweepResult {
  bool hit = false;
  double free_fraction = 1.0;      ///< 0 … 1: the largest fraction found free
  double touching_fraction = 1.0;  ///< the smallest fraction found touching; contacts are looked up here
};

/// What touches what, where and when. Knows shapes and poses; no forces, no time. FCL does the work (in the .cpp
/// alone). Bodies are those of the scene, by index; the bench is the half-space below `scene.bench_height`. Not
/// copyable; one thread at a time. Virtual, so that who uses one from `open_collision_world`
/// (contact/contact_engines.h) is not linked with FCL; who makes one by itself is.
class CollisionWorld {
 public:
  static constexpr std::size_t bench = static_cast<std::size_t>(-1);

  explicit CollisionWorld(const scene::Scene& scene);
  virtual ~CollisionWorld();
  CollisionWorld(CollisionWorld&&) noexcept;
  CollisionWorld& operator=(CollisionWorld&&) noexcept;

  /// Places a body. All bodies start at the scene's poses.
  virtual void set_pose(std::size_t body, const RigidTransform& X_WO);

  /// Broadphase: whether anything else (bench included) comes within `margin` [m] of the body's way from `X0` to `X1`.
  /// May say yes too often, never no wrongly: the rotation between is covered.
  virtual bool may_touch(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                         double margin) const;

  /// Whether the body, placed at `X_WO`, is in another body or the bench by more than `tolerance` [m].
  virtual bool touches(std::size_t body, const RigidTransform& X_WO, double tolerance) const;

  /// The contact points of the body placed at `X_WO` that are deeper than `tolerance` (which may be negative for flat
  /// neighbours such as the bench, to get points that are about to touch). Appended to `contacts`.
  /// A flush box on a plane or on a box gives points that span the common face.
  virtual void find_contacts(std::size_t body, const RigidTransform& X_WO, double tolerance,
                             std::vector<ContactPoint>& contacts) const;

  /// The paper's search (section 5) on the whole way from `X0` to `X1` (straight in position, constant axis in
  /// rotation). It advances by what the gaps leave clear for certain, and if there are none, by steps in which no point
  /// of the body moves further than `resolution` [m]. In the first step that touches, the free and the touching
  /// fraction are found by `levels` halvings, or, with 0, as the time of impact: by what is surely clear again
  /// (conservative advancement, Mirtich 1996).
  virtual SweepResult sweep(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                            double tolerance, double resolution, int levels) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spring_workbench::collision
