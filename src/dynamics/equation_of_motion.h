#pragma once

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/math/positive_definite.h"
#include "spring_workbench/rod/straight_rod.h"
#include "spring_workbench/rod/tip_motion.h"

// The equation of motion itself, written once for one moment (`S` double) and for several side by side (math::Pack).

namespace spring_workbench::dynamics {

template <typename S>
SPRING_WORKBENCH_INLINE void HeldBody::find_tip(const S* q, const S* q_dot, rod::TipOf<S>& tip) const {
  bends_ ? shape_->tip(q, q_dot, tip) : straight_.tip(q, tip);
}

/// The object's motion if the strain rates were constant, and what that takes.
template <typename S>
struct HeldBody::Rigid {
  math::Vec3<S> r_EO;   ///< from tip to centre of mass, axes of H
  math::Vec3<S> p_HO;   ///< axes of H
  math::Vec3<S> v_rel;  ///< of O in the turning frame H
  math::Vec3<S> w_O;    ///< angular velocity, axes of O
  math::Mat3x3<S> R_HO;
  math::Vec3<S> force;     ///< mass times acceleration of O, less gravity, loads and couplings, axes of H
  math::Vec3<S> moment_O;  ///< rate of the angular momentum about O, less the same moments, axes of O
};

template <typename S>
SPRING_WORKBENCH_INLINE HeldBody::Rigid<S> HeldBody::without_strain_acceleration(const HandleRates<S>& handle,
                                                                                 const rod::TipOf<S>& tip,
                                                                                 const S* q_dot,
                                                                                 const S* q_ddot) const {
  const motion::BodyFrameRates<S>& h = handle.of_H;
  Rigid<S> r;  // NOLINT(cppcoreguidelines-pro-type-member-init): all of it is set below
  r.r_EO = tip.R_HE * math::vec3(p_EO_);
  r.R_HO = tip.R_HE * math::mat3x3(R_EO_);
  r.p_HO = tip.p_HE + r.r_EO;
  math::Vec3<S> w_rel = math::zero<S>(), v_E = math::zero<S>();  // of the tip, in the turning frame H
  math::Vec3<S> alpha_rel = tip.angular_bias, a_E = tip.linear_bias;
  rod::add_tip_motion(tip, coordinates_.count(), q_dot, w_rel, v_E);
  if (returning()) rod::add_tip_motion(tip, coordinates_.count(), q_ddot, alpha_rel, a_E);
  r.v_rel = v_E + math::cross(w_rel, r.r_EO);
  const math::Vec3<S>& w_H = h.w_B;
  const math::Vec3<S> a = h.a_B + a_E + math::cross(h.alpha_B, r.p_HO) +
                          math::cross(w_H, math::cross(w_H, r.p_HO) + 2.0 * r.v_rel) + math::cross(alpha_rel, r.r_EO) +
                          math::cross(w_rel, math::cross(w_rel, r.r_EO));
  const math::Vec3<S> alpha_O = math::transposed(r.R_HO, h.alpha_B + math::cross(w_H, w_rel) + alpha_rel);
  r.w_O = math::transposed(r.R_HO, w_H + w_rel);
  const math::Mat3x3<double> I = math::mat3x3(body_.inertia_O);
  r.force = body_.mass * a;
  r.moment_O = I * alpha_O + math::cross(r.w_O, I * r.w_O);
  if (loaded_) {
    r.force = r.force - math::transposed(h.R_WB, math::vec3(load_W_.force));
    r.moment_O = r.moment_O - math::transposed(r.R_HO, math::transposed(h.R_WB, math::vec3(load_W_.moment)));
  }
  if (coupled()) {
    const Pull<S> pull = couplings_.pull(handle.t, handle.relative_motions, {r.R_HO, r.p_HO, r.v_rel, w_rel});
    r.force = r.force - pull.force;
    r.moment_O = r.moment_O - math::transposed(r.R_HO, pull.moment);
  }
  return r;
}

template <typename S>
SPRING_WORKBENCH_INLINE HeldBody::Rigid<S> HeldBody::rigid(const HandleRates<S>& handle, const S* q, const S* q_dot,
                                                           rod::TipOf<S>& tip) const {
  S q_all[rod::max_strain_coordinates], q_dot_all[rod::max_strain_coordinates], q_ddot_all[rod::max_strain_coordinates];
  coordinates_.scatter(q, q_all);
  coordinates_.scatter(q_dot, q_dot_all);
  if (returning()) {
    for (S& x : q_ddot_all) x = S{};
    for (int k = 0; k < math::lanes<S>; ++k) {
      coordinates_.prescribe(math::lane(handle.t, k), k, q_all, q_dot_all, q_ddot_all);
    }
  }
  if constexpr (math::lanes<S> == 1) {
    tip = this->tip(q_all, q_dot_all, true);
  } else {
    find_tip(q_all, q_dot_all, tip);
  }
  return without_strain_acceleration(handle, tip, q_dot_all, q_ddot_all);
}

template <int n, typename S>
SPRING_WORKBENCH_INLINE void HeldBody::spring_forces(const S* q, const S* q_dot, S* forces) const {
  for (int i = 0; i < n; ++i) forces[i] = -K_[coordinates_[i]] * q[i] - D_[coordinates_[i]] * q_dot[i];
  if (!modal_) return;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) forces[i] -= D_modal_(i, j) * q_dot[j];
  }
}

template <int n, typename S>
SPRING_WORKBENCH_INLINE void HeldBody::accelerate(const HandleRates<S>& handle, const S* q, const S* q_dot,
                                                  S* q_ddot) const {
  S springs[n];
  spring_forces<n>(q, q_dot, springs);
  rod::TipOf<S> tip;  // NOLINT(cppcoreguidelines-pro-type-member-init): rigid() sets all of it
  const Rigid<S> without = rigid(handle, q, q_dot, tip);
  math::Vec3<S> linear[n], angular[n], momentum[n];  // of O per strain rate: axes of H, of O, of O
  const math::Mat3x3<double> I = math::mat3x3(body_.inertia_O);
  for (int i = 0; i < n; ++i) {
    const int c = coordinates_[i];
    linear[i] = tip.linear[c] + math::cross(tip.angular[c], without.r_EO);
    angular[i] = math::transposed(without.R_HO, tip.angular[c]);
    momentum[i] = I * angular[i];
  }
  S M[n * n];
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < n; ++i) M[i * n + j] = body_.mass * dot(linear[i], linear[j]) + dot(angular[i], momentum[j]);
    q_ddot[j] = springs[j] - dot(linear[j], without.force) - dot(angular[j], without.moment_O);
  }
  math::solve_positive_definite<n>(M, q_ddot);
}

}  // namespace spring_workbench::dynamics
