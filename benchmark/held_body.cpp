#include "benchmark/held_body.h"

#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {

BodyState body_state(const Scenario& scene, const HandState& hand, const BushingState& state) {
  const Vector3d d = state.q.head<3>(), phi = state.q.tail<3>();
  const Matrix3d R_TE = math::exp_so3(phi);
  const Vector3d w_WE_E =
      R_TE.transpose() * hand.w_WT_T + math::right_jacobian_so3(phi) * Vector3d(state.q_dot.tail<3>());
  const Matrix3d R_WE = hand.R_WT * R_TE;
  BodyState body;
  body.p_WO = hand.p_WT + hand.R_WT * d + R_WE * scene.p_EO;
  body.R_WO = Quaterniond(R_WE).normalized();
  body.v_WO_W = hand.v_WT_W + hand.R_WT * (hand.w_WT_T.cross(d) + Vector3d(state.q_dot.head<3>())) +
                R_WE * w_WE_E.cross(scene.p_EO);
  body.w_WO_O = w_WE_E;
  return body;
}

namespace {

BushingState bushing_state(const Scenario& scene, const HandState& hand, const BodyState& body, const Matrix3d& R_WO) {
  const Matrix3d R_TE = hand.R_WT.transpose() * R_WO;
  const Vector3d p_TE = hand.R_WT.transpose() * (body.p_WO - R_WO * scene.p_EO - hand.p_WT);
  const Vector3d v_WE_W = body.v_WO_W - R_WO * body.w_WO_O.cross(scene.p_EO);
  const Vector3d phi = math::log_so3(R_TE);
  const Vector3d relative_rate = body.w_WO_O - R_TE.transpose() * hand.w_WT_T;
  BushingState state;
  state.q << p_TE, phi;
  state.q_dot << hand.R_WT.transpose() * (v_WE_W - hand.v_WT_W) - hand.w_WT_T.cross(p_TE),
      math::right_jacobian_inverse_so3(phi) * relative_rate;
  return state;
}

}  // namespace

BushingState bushing_state(const Scenario& scene, const HandState& hand, const BodyState& body) {
  return bushing_state(scene, hand, body, body.R_WO.toRotationMatrix());
}

BodyLoad bushing_load(const Scenario& scene, const HandState& hand, const BushingState& state, const Matrix3d& R_WO) {
  const Vector6d generalised = -(scene.stiffness.cwiseProduct(state.q) + scene.damping.cwiseProduct(state.q_dot));
  const Vector3d phi = state.q.tail<3>();
  BodyLoad load;
  load.force_W = hand.R_WT * generalised.head<3>();
  const Vector3d moment_at_tip = math::right_jacobian_inverse_so3(phi).transpose() * generalised.tail<3>();
  load.moment_O = moment_at_tip - scene.p_EO.cross(R_WO.transpose() * load.force_W);
  return load;
}

BodyLoad bushing_load(const Scenario& scene, const HandState& hand, const BodyState& body) {
  const Matrix3d R_WO = body.R_WO.toRotationMatrix();
  return bushing_load(scene, hand, bushing_state(scene, hand, body, R_WO), R_WO);
}

BodyAcceleration body_acceleration(const Scenario& scene, const BodyLoad& load, const Vector3d& w_WO_O) {
  const Vector3d gyroscopic = w_WO_O.cross(scene.inertia.cwiseProduct(w_WO_O));
  return {load.force_W / scene.mass - scene.gravity * Vector3d::UnitZ(),
          (load.moment_O - gyroscopic).cwiseQuotient(scene.inertia)};
}

Vector6d bushing_acceleration(const Scenario& scene, const HandMotion& motion, const BushingState& state) {
  const auto& [hand, hand_rate] = motion;
  const Vector3d d = state.q.head<3>(), phi = state.q.tail<3>();
  const Vector3d d_dot = state.q_dot.head<3>(), phi_dot = state.q_dot.tail<3>();
  const Matrix3d R_TE = math::exp_so3(phi);
  const Matrix3d R_WE = hand.R_WT * R_TE;
  const Vector3d& w_WT_T = hand.w_WT_T;
  const Vector3d w_WT_E = R_TE.transpose() * w_WT_T;
  const Vector3d w_TE_E = math::right_jacobian_so3(phi) * phi_dot;
  const Vector3d w_WE_E = w_WT_E + w_TE_E;

  const BodyAcceleration body = body_acceleration(scene, bushing_load(scene, hand, state, R_WE), w_WE_E);
  const Vector3d a_WE_W =
      body.a_WO_W - R_WE * (body.alpha_WO_O.cross(scene.p_EO) + w_WE_E.cross(w_WE_E.cross(scene.p_EO)));
  const Vector3d d_ddot = hand.R_WT.transpose() * (a_WE_W - hand_rate.a_WT_W) - hand_rate.alpha_WT_T.cross(d) -
                          2.0 * w_WT_T.cross(d_dot) - w_WT_T.cross(w_WT_T.cross(d));
  const Vector3d alpha_TE_E = body.alpha_WO_O - R_TE.transpose() * hand_rate.alpha_WT_T + w_TE_E.cross(w_WT_E);
  const Vector3d phi_ddot =
      math::right_jacobian_inverse_so3(phi) * (alpha_TE_E - math::right_jacobian_rate_so3(phi, phi_dot, phi_dot));
  Vector6d q_ddot;
  q_ddot << d_ddot, phi_ddot;
  return q_ddot;
}

BodyState start_state(const Scenario& scene) { return body_state(scene, hand_state(scene, 0.0), BushingState()); }

FreeBody free_body(const Scenario& scene) {
  const double gravity = scene.kind == SceneKind::torsion ? 0.0 : scene.gravity;
  return {scene.mass, scene.inertia, gravity, start_state(scene)};
}

Vector3d rigid_output(const Scenario& scene, double t) {
  if (scene.kind == SceneKind::torsion) return Vector3d(0.0, 0.0, scalar_hand(scene, t).value);
  const HandState hand = hand_state(scene, t);
  return hand.p_WT + hand.R_WT * scene.p_EO;
}

Vector3d scene_output(const Scenario& scene, const RigidTransform& X_WO) {
  if (scene.kind != SceneKind::torsion) return X_WO.translation();
  return {0.0, 0.0, math::log_so3(X_WO.linear()).z()};
}

}  // namespace spring_workbench::benchmark
