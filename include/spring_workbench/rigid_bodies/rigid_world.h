#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "spring_workbench/math/spatial.h"
#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::rigid_bodies {

/// Body whose motion over the step is known except for the effect of contact: the held body on its fork. The world
/// solves its contacts as exactly as those of its own bodies, with the compliance of the fork, so that no stiffness and
/// no mass makes the pair unstable. If a contact is closed at the start of the step, an impulse removes its approach
/// speed; then the body moves under a constant load.
struct DrivenBody {
  std::size_t body = 0;                              ///< index in the scene
  RigidTransform X_WO = RigidTransform::Identity();  ///< pose at the start of the step
  Twist displacement_W;                              ///< over the step without contact, at O, world axes [m, rad]
  /// Change of the displacement [m, rad] per constant wrench at O over the step, in world axes; symmetric, ≥ 0.
  Matrix6d compliance = Matrix6d::Zero();
  Twist V_WO_W;                          ///< twist at the start of the step
  Matrix6d mobility = Matrix6d::Zero();  ///< change of the velocity per impulse; symmetric, ≥ 0
  Matrix6d displacement_by_impulse =
      Matrix6d::Zero();  ///< change of the displacement over the step per impulse at its start
  Wrench impact_W;       ///< out: the impulse of contact at the start, at O [N·s, N·m·s]
  Wrench contact_W;      ///< out: the remaining contact load, constant over the step, at O [N, N·m]
};

/// Contact point at which two bodies press on each other.
struct WorldContact {
  std::size_t body = 0;                   ///< index in the scene
  std::size_t other = 0;                  ///< index in the scene or `RigidWorld::bench`
  Vector3d p_W = Vector3d::Zero();        ///< [m]
  Vector3d n_W = Vector3d::UnitZ();       ///< unit normal, from `other` towards `body`
  double depth = 0.0;                     ///< penetration before the step [m]
  Vector3d impulse_W = Vector3d::Zero();  ///< on `body`, in the last step [N·s]

  void archive(math::StateArchive& state) { state(body, other, p_W, n_W, depth, impulse_W); }
};

/// Returns the largest depth of a contact between two bodies [m], 0 if there is none.
inline double depth_between(std::size_t a, std::size_t b, const std::vector<WorldContact>& contacts) {
  double depth = 0.0;
  for (const WorldContact& c : contacts) {
    if ((c.body == a && c.other == b) || (c.body == b && c.other == a)) depth = std::max(depth, c.depth);
  }
  return depth;
}

/// Rigid-body world of all bodies of the scene, for contact mode `dynamic` (doc/model.md). Friction is Coulomb's with a
/// round cone, the pair's coefficients are geometric means. Bodies at rest fall asleep and leave the world until
/// something comes near, so they cost nothing. The world is deterministic. Only one thread may use it at a time.
class RigidWorld {
 public:
  static constexpr std::size_t bench = static_cast<std::size_t>(-1);
  using Bodies = std::vector<std::size_t>;  ///< indices in the scene

  virtual ~RigidWorld() = default;

  /// Advances the world by `h` [s] > 0. It does not move driven bodies: place() them afterwards.
  virtual void step(double h, std::vector<DrivenBody>& driven) = 0;

  /// Restores all bodies that are not driven to their states before the last step, so that it can be repeated
  /// differently. What the step has learnt about contacts is kept for the next try.
  virtual void undo_step() = 0;

  /// Places a movable body at a pose with a velocity, awake or asleep.
  virtual void place(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W, bool awake) = 0;

  virtual const RigidTransform& pose(std::size_t body) const = 0;
  virtual const Twist& velocity(std::size_t body) const = 0;  ///< twist at O, world axes
  virtual bool awake(std::size_t body) const = 0;             ///< false for one that is not movable

  /// Broadphase: returns what is movable and comes near the path of the body over `h` [s]: sleeping bodies, and those
  /// that are awake or in `carried`, on their own paths. The search ends when it has found `max_count` of them.
  virtual Bodies movable_near(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO, double h,
                              const Bodies& carried, std::size_t max_count) const = 0;

  /// Broadphase: returns whether anything else, including the bench, comes within `margin` [m] of the path of the body;
  /// the rotation is covered.
  virtual bool may_touch(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                         double margin) const = 0;

  /// Fraction (0 … 1) of the path from `X0_WO` to `X1_WO`, straight and evenly turning, that the body can certainly
  /// travel without touching anything. The other bodies are assumed to be at rest.
  virtual double collision_free_fraction(std::size_t body, const RigidTransform& X0_WO,
                                         const RigidTransform& X1_WO) const = 0;
  /// Fraction (0 … 1) of that path that the body can certainly travel without passing through anything and, between
  /// boxes, without penetrating by more than 0.05 mm (in addition to what compliant materials yield) or its initial
  /// depth, whichever is larger. At most 0.5 if the last step was not solved to 1 µm. The other bodies are assumed to
  /// have moved straight in the last step.
  virtual double admissible_fraction(std::size_t body, const RigidTransform& X0_WO,
                                     const RigidTransform& X1_WO) const = 0;
  /// Fraction (0 … 1) of the last step over which the free bodies have certainly not passed through anything 1 mm
  /// thick.
  virtual double admissible_fraction_of_free() const = 0;
  /// Time from the start of the last step to the next moment at which a free body touches something that it bounces off
  /// [s], or less; infinite if none approaches. If the step was longer, it has to be undone and repeated with that
  /// duration: bodies bounce only at the start of a step.
  virtual double first_bounce() const = 0;
  /// Estimate of the largest error of a free body's path in the last step [m], of any of its points, because its loads
  /// were not constant or turned; for a body that touches nothing it is zero.
  virtual double path_error() const = 0;
  /// Returns whether the contacts of the last step were solved to 1 µm, none of rigid materials was deeper than 0.1 mm
  /// at its start, and none is known to be missing.
  virtual bool solved() const = 0;

  /// Contacts of the last step that carried a load or were closed.
  virtual const std::vector<WorldContact>& contacts() const = 0;
  /// Indices in the scene of the bodies in the world at present: those awake and those near them.
  virtual const std::vector<std::size_t>& bodies_near() const = 0;

  /// Saves or restores the whole state between two steps.
  virtual void archive(math::StateArchive& state) = 0;
};

/// Makes the world with all movable bodies asleep at the poses of the scene. It uses Bullet in double precision. Code
/// that calls this function must link against Bullet; `open_rigid_world` (contact/contact_engines.h) loads it when it
/// is needed.
std::unique_ptr<RigidWorld> make_rigid_world(const scene::Scene& scene);

}  // namespace spring_workbench::rigid_bodies
