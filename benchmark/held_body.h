#pragma once

#include "benchmark/scenarios.h"

namespace spring_workbench::benchmark {

/// State of the held object in world, as stored by a physics engine.
struct BodyState {
  Vector3d p_WO = Vector3d::Zero();  ///< [m]
  Quaterniond R_WO = Quaterniond::Identity();
  Vector3d v_WO_W = Vector3d::Zero();  ///< [m/s]
  Vector3d w_WO_O = Vector3d::Zero();  ///< angular velocity in the object's axes [rad/s]
};

/// Force [N] and moment [N·m] on the object about its centre of mass.
struct BodyLoad {
  Vector3d force_W = Vector3d::Zero();
  Vector3d moment_O = Vector3d::Zero();
};

/// Coordinates and rates of the bushing, (d, φ) and (ḋ, φ̇).
struct BushingState {
  Vector6d q = Vector6d::Zero();
  Vector6d q_dot = Vector6d::Zero();
};

/// The state of the object in world for a state of the bushing.
BodyState body_state(const Scenario& scene, const HandState& hand, const BushingState& state);

/// The bushing state of an object in world; |φ| below π.
BushingState bushing_state(const Scenario& scene, const HandState& hand, const BodyState& body);

/// Load of the bushing on the object, without gravity. With `F = −(k d + c ḋ)` in T and the generalised moment `τ = −(k
/// φ + c φ̇)`, virtual work gives the force F at the tip and the moment `J_r⁻ᵀ(φ) τ` in E, `J_r` the right Jacobian of
/// SO(3) (`J_r φ̇` is the tip's rate relative to T, in E).
BodyLoad bushing_load(const Scenario& scene, const HandState& hand, const BushingState& state, const Matrix3d& R_WO);
BodyLoad bushing_load(const Scenario& scene, const HandState& hand, const BodyState& body);

/// Equation of motion of scene C in Lagrange's coordinates: `q̈(t, q, q̇)`, the hand at t. Newton and Euler for the
/// object under `bushing_load` and gravity, carried over to the moving frame T.
Vector6d bushing_acceleration(const Scenario& scene, const HandMotion& hand, const BushingState& state);

/// Linear [m/s²] and angular acceleration [rad/s², in O] of the object under a load and gravity.
struct BodyAcceleration {
  Vector3d a_WO_W;
  Vector3d alpha_WO_O;
};
BodyAcceleration body_acceleration(const Scenario& scene, const BodyLoad& load, const Vector3d& w_WO_O);

/// The object at t = 0: zero strain, zero strain rate.
BodyState start_state(const Scenario& scene);

/// A rigid body as it is put into an engine, free but for gravity along −z of W and loads.
struct FreeBody {
  double mass = 1.0;                    ///< [kg]
  Vector3d inertia = Vector3d::Ones();  ///< principal, about and in O [kg m²]
  double gravity = 9.81;                ///< [m/s²]
  BodyState start;
};
/// The object of a scene. The torsion spring does not carry the weight: no gravity in scene B.
FreeBody free_body(const Scenario& scene);

/// Output for a rigid fork: A and C centre of the object [m], B (0, 0, twist) [rad].
Vector3d rigid_output(const Scenario& scene, double t);

/// The same output for an object at `X_WO`.
Vector3d scene_output(const Scenario& scene, const RigidTransform& X_WO);

}  // namespace spring_workbench::benchmark
