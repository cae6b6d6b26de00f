#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "spring_workbench/math/spatial.h"
#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::rigid_bodies {

/// A body whose motion over the step is known but for what contact does to it: the held body on its fork. The world
/// takes its contacts into account as exactly as those of its own bodies, with the answer that the fork's stiffness and
/// damping give, so that no stiffness and no mass makes the pair blow up. Where it is closed at the start of the step,
/// its approach is taken away by an impulse; then it moves under a constant load.
struct DrivenBody {
  std::size_t body = 0;                              ///< index in the scene
  RigidTransform X_WO = RigidTransform::Identity();  ///< pose at the start of the step
  Twist displacement_W;                              ///< over the step without contact, at O, world axes [m, rad]
  /// How the displacement [m, rad] answers to a constant wrench at O over the step, world axes; symmetric, ≥ 0.
  Matrix6d compliance = Matrix6d::Zero();
  Twist V_WO_W;                          ///< at the start of the step
  Matrix6d mobility = Matrix6d::Zero();  ///< how the velocity answers to an impulse; symmetric, ≥ 0
  Matrix6d displacement_by_impulse =
      Matrix6d::Zero();  ///< how the displacement over the step answers to an impulse at its start
  Wrench impact_W;       ///< out: the impulse of contact at the start, at O [N·s, N·m·s]
  Wrench contact_W;      ///< out: what contact does besides, constant over the step, at O [N, N·m]
};

/// A place where two bodies press on each other.
struct WorldContact {
  std::size_t body = 0;                   ///< index in the scene
  std::size_t other = 0;                  ///< index in the scene or `RigidWorld::bench`
  Vector3d p_W = Vector3d::Zero();        ///< [m]
  Vector3d n_W = Vector3d::UnitZ();       ///< unit normal, from `other` towards `body`
  double depth = 0.0;                     ///< penetration before the step [m]
  Vector3d impulse_W = Vector3d::Zero();  ///< on `body`, in the last step [N·s]

  void exchange(math::StateArchive& state) { state(body, other, p_W, n_W, depth, impulse_W); }
};

/// What moves together in contact mode `dynamic` (doc/model.md): all bodies of the scene in one rigid-body world.
/// Friction is Coulomb's with a round cone, the pair's coefficients are geometric means. Bodies at rest are put to
/// sleep and leave the world until something comes near: they cost nothing. Deterministic. One thread at a time.
class RigidWorld {
 public:
  static constexpr std::size_t bench = static_cast<std::size_t>(-1);

  virtual ~RigidWorld() = default;

  /// Goes `h` [s] > 0 on. Driven bodies are only looked at: place() them afterwards.
  virtual void step(double h, std::vector<DrivenBody>& driven) = 0;

  /// All bodies that are not driven go back to where the last step found them, to take it in another way; what it found
  /// out about contacts stays for the next try.
  virtual void undo_step() = 0;

  /// Puts a movable body somewhere, awake or asleep.
  virtual void place(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W, bool awake) = 0;

  virtual const RigidTransform& pose(std::size_t body) const = 0;
  virtual const Twist& velocity(std::size_t body) const = 0;  ///< at O, world axes
  virtual bool awake(std::size_t body) const = 0;             ///< false for one that is not movable

  /// Broadphase: whether anything movable comes near the body's way over `h` [s]: a sleeper, or one awake or of
  /// `carried` on its own way.
  virtual bool near_movable(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO, double h,
                            const std::vector<std::size_t>& carried) const = 0;

  /// Broadphase: whether anything else (bench included) comes within `margin` [m] of the body's way, rotation covered.
  virtual bool may_touch(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                         double margin) const = 0;

  /// Which part of the body's way from `X0_WO` to `X1_WO`, straight and evenly turning, it surely goes without touching
  /// anything; 0 … 1. Others are taken to stand still.
  virtual double collision_free_fraction(std::size_t body, const RigidTransform& X0_WO,
                                         const RigidTransform& X1_WO) const = 0;
  /// Which part it surely goes without having gone through anything or, among boxes, without being deeper than 0.05 mm,
  /// or than at the start (half, if the last step was not solved to 1 µm). Others have gone straight in the last step.
  virtual double admissible_fraction(std::size_t body, const RigidTransform& X0_WO,
                                     const RigidTransform& X1_WO) const = 0;
  /// Which part of the last step the free bodies surely went without having gone through anything 1 mm thick.
  virtual double admissible_fraction_of_free() const = 0;

  /// Contacts of the last step that pressed or were closed.
  virtual const std::vector<WorldContact>& contacts() const = 0;
  /// Bodies of the scene that have to be looked at, at present: those awake and what is near them.
  virtual const std::vector<std::size_t>& bodies_near() const = 0;

  /// All of its state between two steps.
  virtual void exchange(math::StateArchive& state) = 0;
};

/// All movable bodies begin asleep at the scene's poses. Bullet does the work, in double precision. Who calls this is
/// linked with it; `open_rigid_world` (contact/contact_engines.h) opens it when it is needed.
std::unique_ptr<RigidWorld> make_rigid_world(const scene::Scene& scene);

}  // namespace spring_workbench::rigid_bodies
