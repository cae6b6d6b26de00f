// The accelerations of the held body: the equation of motion itself, in one moment or in packs of them.
#include <cmath>
#include <type_traits>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/math/by_size.h"
#include "spring_workbench/math/positive_definite.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::dynamics {

template <typename S>
struct HeldBody::Rigid {
  math::Three<S> r_EO;   ///< from tip to centre of mass, axes of H
  math::Three<S> p_HO;   ///< axes of H
  math::Three<S> v_rel;  ///< of O in the turning frame H
  math::Three<S> w_O;    ///< angular velocity, axes of O
  math::ThreeByThree<S> R_HO;
  math::Three<S> force;     ///< mass times acceleration of O, less gravity and contact, axes of H
  math::Three<S> moment_O;  ///< rate of the angular momentum about O, less the contact's moment, axes of O
};

namespace {

/// What `size` rates (or accelerations) of the strain add to the tip's angular and linear one.
template <typename S>
SPRING_WORKBENCH_INLINE void add_tip_motion(const rod::TipOf<S>& tip, int size, const S* rate, math::Three<S>& angular,
                                            math::Three<S>& linear) {
  for (int i = 0; i < size; ++i) {
    angular += rate[i] * tip.angular[i];
    linear += rate[i] * tip.linear[i];
  }
}

}  // namespace

template <typename S>
SPRING_WORKBENCH_INLINE HeldBody::Rigid<S> HeldBody::without_strain_acceleration(const ForcingOf<S>& handle,
                                                                                 const rod::TipOf<S>& tip,
                                                                                 const S* q_dot,
                                                                                 const S* q_ddot) const {
  const motion::FrameForcing<S>& h = handle.of_H;
  Rigid<S> r;  // NOLINT(cppcoreguidelines-pro-type-member-init): all of it is set below
  r.r_EO = tip.R_HE * math::three(p_EO_);
  r.R_HO = tip.R_HE * math::three_by_three(R_EO_);
  r.p_HO = tip.p_HE + r.r_EO;
  math::Three<S> w_rel = math::none<S>(), v_E = math::none<S>();  // of the tip, in the turning frame H
  math::Three<S> alpha_rel = tip.angular_bias, a_E = tip.linear_bias;
  add_tip_motion(tip, coordinates_.count(), q_dot, w_rel, v_E);
  if (returning()) add_tip_motion(tip, coordinates_.count(), q_ddot, alpha_rel, a_E);
  r.v_rel = v_E + math::cross(w_rel, r.r_EO);
  const math::Three<S>& w_H = h.w_B;
  const math::Three<S> a = h.a_B + a_E + math::cross(h.alpha_B, r.p_HO) +
                           math::cross(w_H, math::cross(w_H, r.p_HO) + 2.0 * r.v_rel) + math::cross(alpha_rel, r.r_EO) +
                           math::cross(w_rel, math::cross(w_rel, r.r_EO));
  const math::Three<S> alpha_O = math::transposed(r.R_HO, h.alpha_B + math::cross(w_H, w_rel) + alpha_rel);
  r.w_O = math::transposed(r.R_HO, w_H + w_rel);
  const math::ThreeByThree<double> I = math::three_by_three(body_.inertia_O);
  r.force = body_.mass * a;
  r.moment_O = I * alpha_O + math::cross(r.w_O, I * r.w_O);
  if (loaded_) {
    r.force = r.force - math::transposed(h.R_WB, math::three(external_W_.force));
    r.moment_O = r.moment_O - math::transposed(r.R_HO, math::transposed(h.R_WB, math::three(external_W_.moment)));
  }
  if (coupled()) {
    const Pull<S> pull = couplings_.pull(handle.t, handle.seen, {r.R_HO, r.p_HO, r.v_rel, w_rel});
    r.force = r.force - pull.force;
    r.moment_O = r.moment_O - math::transposed(r.R_HO, pull.moment);
  }
  return r;
}

template <int n, typename S>
SPRING_WORKBENCH_INLINE void HeldBody::accelerate(const ForcingOf<S>& handle, const S* q, const S* q_dot, S* q_ddot,
                                                  EnergyBalance* balance) const {
  const motion::FrameForcing<S>& h = handle.of_H;
  S q_all[rod::max_strain_coordinates], q_dot_all[rod::max_strain_coordinates], q_ddot_all[rod::max_strain_coordinates];
  coordinates_.scatter(q, q_all);
  coordinates_.scatter(q_dot, q_dot_all);
  if (returning()) {
    for (S& x : q_ddot_all) x = S{};
    for (int k = 0; k < math::lanes<S>; ++k) {
      coordinates_.prescribe(math::lane(handle.t, k), k, q_all, q_dot_all, q_ddot_all);
    }
  }
  S springs[n];
  for (int i = 0; i < n; ++i) springs[i] = -K_[coordinates_[i]] * q[i] - D_[coordinates_[i]] * q_dot[i];
  if (modal_) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) springs[i] -= D_modal_(i, j) * q_dot[j];
    }
  }
  rod::TipOf<S> tip;  // NOLINT(cppcoreguidelines-pro-type-member-init): tip() sets all of it
  shape_->tip(q_all, q_dot_all, tip);
  const Rigid<S> rigid = without_strain_acceleration(handle, tip, q_dot_all, q_ddot_all);
  math::Three<S> linear[n], angular[n], momentum[n];  // of O: axes of H and of O
  const math::ThreeByThree<double> I = math::three_by_three(body_.inertia_O);
  for (int i = 0; i < n; ++i) {
    const int c = coordinates_[i];
    linear[i] = tip.linear[c] + math::cross(tip.angular[c], rigid.r_EO);
    angular[i] = math::transposed(rigid.R_HO, tip.angular[c]);
    momentum[i] = I * angular[i];
  }
  S M[n * n];
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < n; ++i) M[i * n + j] = body_.mass * dot(linear[i], linear[j]) + dot(angular[i], momentum[j]);
    q_ddot[j] = springs[j] - dot(linear[j], rigid.force) - dot(angular[j], rigid.moment_O);
  }
  math::solve_positive_definite<n>(M, q_ddot);
  if constexpr (std::is_same_v<S, math::Pack>) {
    if (balance == nullptr) return;
    S elastic{}, damped{};
    for (int i = 0; i < n; ++i) {
      const S pull = K_[coordinates_[i]] * q[i];
      elastic += 0.5 * pull * q[i];
      damped += (springs[i] + pull) * q_dot[i];
    }
    const math::Three<S> v = h.v_B + math::cross(h.w_B, rigid.p_HO) + rigid.v_rel, spin = I * rigid.w_O;
    const math::Three<S> about_H = rigid.R_HO * spin + body_.mass * math::cross(rigid.p_HO, v);
    const math::Three<S> g = gravity_ * math::Three<S>{h.R_WB.x.z, h.R_WB.y.z, h.R_WB.z.z};
    const math::Three<S> changed = h.a_B - g - math::cross(h.w_B, h.v_B);  // rate of h.v_B
    balance->energy = elastic + 0.5 * (body_.mass * dot(v, v) + dot(rigid.w_O, spin)) +
                      body_.mass * (dot(g, rigid.p_HO) - dot(v, h.v_B)) - dot(about_H, h.w_B);
    balance->power =
        damped - dot(about_H, h.alpha_B) + body_.mass * (dot(h.w_B, math::cross(rigid.p_HO, g)) - dot(v, changed));
    if (loaded_) {
      balance->power += dot(math::transposed(h.R_WB, math::three(external_W_.force)), rigid.v_rel) +
                        dot(math::transposed(h.R_WB, math::three(external_W_.moment)), rigid.R_HO * rigid.w_O - h.w_B);
    }
  }
}

template <int n>
Eigen::Matrix<double, n, 1> HeldBody::acceleration(const HandleForcing& h, const Eigen::Matrix<double, n, 1>& q,
                                                   const Eigen::Matrix<double, n, 1>& q_dot) const {
  const ForcingOf<double> forcing{
      h.t,
      {math::three_by_three(h.X_WH.linear()), math::none<double>(), math::three(h.angular_velocity),
       math::three(h.angular_acceleration), math::three(h.acceleration_less_gravity)},
      h.seen};
  Eigen::Matrix<double, n, 1> q_ddot;
  accelerate<n>(forcing, q.data(), q_dot.data(), q_ddot.data());
  return q_ddot;
}

template <int n>
SPRING_WORKBENCH_WIDE void HeldBody::acceleration(const HandleForcings& h, const math::Pack* q, const math::Pack* q_dot,
                                                  math::Pack* q_ddot) const {
  accelerate<n, math::Pack>(h, q, q_dot, q_ddot);
}

#define SPRING_WORKBENCH_FOR_SIZE(n)                                                                                \
  template Eigen::Matrix<double, n, 1> HeldBody::acceleration<n>(                                                   \
      const HandleForcing&, const Eigen::Matrix<double, n, 1>&, const Eigen::Matrix<double, n, 1>&) const;          \
  template void HeldBody::acceleration<n>(const HandleForcings&, const math::Pack*, const math::Pack*, math::Pack*) \
      const;
SPRING_WORKBENCH_FOR_SIZE(1)
SPRING_WORKBENCH_FOR_SIZE(2)
SPRING_WORKBENCH_FOR_SIZE(3)
SPRING_WORKBENCH_FOR_SIZE(4)
SPRING_WORKBENCH_FOR_SIZE(5)
SPRING_WORKBENCH_FOR_SIZE(6)
#undef SPRING_WORKBENCH_FOR_SIZE

template <int n>
SPRING_WORKBENCH_WIDE void HeldBody::balance(const HandleForcings& h, const math::Pack* q, const math::Pack* q_dot,
                                             EnergyBalance& out) const {
  math::Pack q_ddot[n];
  accelerate<n, math::Pack>(h, q, q_dot, q_ddot, &out);
}

rod::StrainVector HeldBody::acceleration(const HandleForcing& h, const rod::StrainVector& q,
                                         const rod::StrainVector& q_dot) const {
  return math::by_size(size(), [&](auto size) -> rod::StrainVector {
    constexpr int n = decltype(size)::value;
    return acceleration<n>(h, Eigen::Matrix<double, n, 1>(q), Eigen::Matrix<double, n, 1>(q_dot));
  });
}

EnergyBalance HeldBody::energy_balance(const HandleForcings& h, const math::Pack* q, const math::Pack* q_dot) const {
  EnergyBalance all = math::by_size(size(), [&](auto size) {
    EnergyBalance out;  // NOLINT(cppcoreguidelines-pro-type-member-init): balance() sets all of it
    balance<decltype(size)::value>(h, q, q_dot, out);
    return out;
  });
  for (int k = 0; k < math::pack_size && coupled(); ++k) {
    StrainState state = zero_state();
    for (int i = 0; i < size(); ++i) {
      state.q[i] = q[i][k];
      state.q_dot[i] = q_dot[i][k];
    }
    const HandleForcing at = h.at(k);
    const Couplings::Reading others = read_couplings(at, state);
    const Vector3d p_HO_W = object(at, state).X.translation() - at.X_WH.translation();
    const Wrench& pull = others.pull_W;
    all.energy[k] += others.springs.energy;
    all.power[k] += others.power - pull.force.dot(at.v_WH_W) -
                    (pull.moment + p_HO_W.cross(pull.force)).dot(at.X_WH.linear() * at.angular_velocity);
  }
  return all;
}

Couplings::Reading HeldBody::read_couplings(const HandleForcing& h, const StrainState& state) const {
  if (!coupled()) return {};
  const StrainState full = full_state(h.t, state);
  const rod::TipOf<double>& tip = this->tip(full.q.data(), full.q_dot.data(), false);
  math::Three<double> w = math::none<double>(), v = w;
  add_tip_motion(tip, coordinates_.count(), full.q_dot.data(), w, v);
  const math::Three<double> r_EO = tip.R_HE * math::three(p_EO_);
  const Matrix3d& R_WH = h.X_WH.linear();
  return couplings_.read(h.t, h.seen,
                         {tip.R_HE * math::three_by_three(R_EO_), tip.p_HE + r_EO, v + math::cross(w, r_EO), w},
                         {math::three_by_three(R_WH), math::three(h.X_WH.translation()),
                          math::three(Vector3d(R_WH.transpose() * h.v_WH_W)), math::three(h.angular_velocity)});
}

motion::MotionState HeldBody::object(const HandleForcing& h, const StrainState& state,
                                     const rod::StrainVector* q_ddot) const {
  double q[rod::max_strain_coordinates], rate[rod::max_strain_coordinates], acceleration[rod::max_strain_coordinates]{};
  coordinates_.scatter(state.q.data(), q);
  coordinates_.scatter(state.q_dot.data(), rate);
  if (q_ddot != nullptr) coordinates_.scatter(q_ddot->data(), acceleration);
  if (returning()) coordinates_.prescribe(h.t, 0, q, rate, acceleration);
  const rod::TipOf<double>& tip = this->tip(q, rate, q_ddot != nullptr);
  // Of the tip, in the turning frame H.
  math::Three<double> w = math::none<double>(), v = w, alpha = tip.angular_bias, a = tip.linear_bias;
  add_tip_motion(tip, coordinates_.count(), rate, w, v);
  if (q_ddot != nullptr) add_tip_motion(tip, coordinates_.count(), acceleration, alpha, a);
  const math::Three<double> r_EO = tip.R_HE * math::three(p_EO_), p_HO = tip.p_HE + r_EO,
                            v_rel = v + math::cross(w, r_EO);
  const math::Three<double> w_H = math::three(h.angular_velocity), alpha_H = math::three(h.angular_acceleration);
  const math::ThreeByThree<double> R_WH = math::three_by_three(h.X_WH.linear());
  motion::MotionState s;
  s.X.linear() = math::matrix(R_WH * (tip.R_HE * math::three_by_three(R_EO_)), 0);
  s.X.translation() = h.X_WH.translation() + math::vector(R_WH * p_HO);
  s.velocity.linear = h.v_WH_W + math::vector(R_WH * (math::cross(w_H, p_HO) + v_rel));
  s.velocity.angular = math::vector(R_WH * (w_H + w));
  if (q_ddot != nullptr) {
    const math::Three<double> of_O = a + math::cross(alpha, r_EO) + math::cross(w, math::cross(w, r_EO));
    const math::Three<double> a_H = math::three(h.acceleration_less_gravity) + of_O + math::cross(alpha_H, p_HO) +
                                    math::cross(w_H, math::cross(w_H, p_HO) + 2.0 * v_rel);
    s.acceleration.linear = math::vector(R_WH * a_H) - gravity_ * Vector3d::UnitZ();
    s.acceleration.angular = math::vector(R_WH * (alpha_H + math::cross(w_H, w) + alpha));
  }
  return s;
}

}  // namespace spring_workbench::dynamics
