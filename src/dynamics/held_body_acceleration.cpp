// The accelerations of the held body: the equation of motion itself, in one moment or in packs of them.
#include <cmath>
#include <type_traits>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/math/positive_definite.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::dynamics {

template <typename S>
void HeldBody::prescribe(double t, int k, S* q, S* q_dot, S* q_ddot) const {
  for (int i = 0; i < shape_size_; ++i) {
    const auto c = static_cast<std::size_t>(i);
    if (mode_[c] != Mode::returning) continue;
    // (B + A τ) e^{−τ/T}: the paper's critically damped closed form (section 3.3).
    const Return& r = return_[c];
    const double rate = 1.0 / r.time_constant;
    const double tau = t - r.t0;
    const double decay = std::exp(-rate * tau);
    const double A = r.rate0 + rate * r.q0;
    const double x = (r.q0 + A * tau) * decay, v = A * decay - rate * x;
    math::set_lane(q[i], k, x);
    math::set_lane(q_dot[i], k, v);
    math::set_lane(q_ddot[i], k, -rate * A * decay - rate * v);
  }
}

template void HeldBody::prescribe(double t, int k, double* q, double* q_dot, double* q_ddot) const;

template <typename S>
struct HeldBody::Rigid {
  math::Three<S> r_EO;  ///< from tip to centre of mass, axes of H
  math::ThreeByThree<S> R_HO;
  math::Three<S> force;     ///< mass times acceleration of O, less gravity and contact, axes of H
  math::Three<S> moment_O;  ///< rate of the angular momentum about O, less the contact's moment, axes of O
};

namespace {

/// What `size` rates (or accelerations) of the strain add to the tip's angular and linear one.
template <typename S>
SPRING_WORKBENCH_INLINE void add_tip_motion(const rod::TipOf<S>& tip, int size, const S* rate, math::Three<S>& angular,
                                            math::Three<S>& linear) {
  if (tip.separate) {
    angular += rate[2] * tip.angular[2] + rate[3] * tip.angular[3] + rate[4] * tip.angular[4];
    linear += math::Three<S>{rate[0], rate[1], rate[5]};
    return;
  }
  for (int i = 0; i < size; ++i) {
    angular += rate[i] * tip.angular[i];
    linear += rate[i] * tip.linear[i];
  }
}

}  // namespace

template <typename S>
SPRING_WORKBENCH_INLINE HeldBody::Rigid<S> HeldBody::without_strain_acceleration(const motion::FrameForcing<S>& h,
                                                                                 const rod::TipOf<S>& tip,
                                                                                 const S* q_dot,
                                                                                 const S* q_ddot) const {
  Rigid<S> r;
  r.r_EO = tip.R_HE * math::three(p_EO_);
  r.R_HO = tip.R_HE * math::three_by_three(R_EO_);
  const math::Three<S> p_HO = tip.p_HE + r.r_EO;
  math::Three<S> w_rel = math::none<S>(), v_E = math::none<S>();  // of the tip, in the turning frame H
  math::Three<S> alpha_rel = tip.angular_bias, a_E = tip.linear_bias;
  add_tip_motion(tip, shape_size_, q_dot, w_rel, v_E);
  if (returning_ > 0) add_tip_motion(tip, shape_size_, q_ddot, alpha_rel, a_E);
  const math::Three<S> v_rel = v_E + math::cross(w_rel, r.r_EO);
  const math::Three<S>& w_H = h.w_B;
  const math::Three<S> a = h.a_B + a_E + math::cross(h.alpha_B, p_HO) +
                           math::cross(w_H, math::cross(w_H, p_HO) + 2.0 * v_rel) + math::cross(alpha_rel, r.r_EO) +
                           math::cross(w_rel, math::cross(w_rel, r.r_EO));
  const math::Three<S> alpha_O = math::transposed(r.R_HO, h.alpha_B + math::cross(w_H, w_rel) + alpha_rel);
  const math::Three<S> w_O = math::transposed(r.R_HO, w_H + w_rel);
  const math::ThreeByThree<double> I = math::three_by_three(body_.inertia_O);
  r.force = body_.mass * a;
  r.moment_O = I * alpha_O + math::cross(w_O, I * w_O);
  if (loaded_) {
    r.force = r.force - math::transposed(h.R_WB, math::three(external_W_.force));
    r.moment_O = r.moment_O - math::transposed(r.R_HO, math::transposed(h.R_WB, math::three(external_W_.moment)));
  }
  return r;
}

/// The body slides along the fork's axis: Newton's law along it.
template <typename S>
SPRING_WORKBENCH_INLINE S HeldBody::slide(const motion::FrameForcing<S>& h, const S& extension, S force) const {
  const S zero{};
  const math::Three<S> p_HO{zero + p_EO_.x(), zero + p_EO_.y(), extension + (shape_->length() + p_EO_.z())};
  if (loaded_) force += math::transposed(h.R_WB, math::three(external_W_.force)).z;
  const S a_z =
      h.a_B.z + h.alpha_B.x * p_HO.y - h.alpha_B.y * p_HO.x + h.w_B.z * dot(h.w_B, p_HO) - p_HO.z * dot(h.w_B, h.w_B);
  return force * (1.0 / body_.mass) - a_z;
}

/// The body turns about the fork's axis: Euler's law about it, in the axes of the tip E, where the body is at rest.
template <typename S>
SPRING_WORKBENCH_INLINE S HeldBody::turn(const motion::FrameForcing<S>& h, const S& twist, const S& rate,
                                         S moment) const {
  const math::So3CoefficientsOf<S> k = math::so3_coefficients(S(twist * twist));
  const S sine = twist * k.a, cosine = 1.0 - twist * twist * k.b;
  const auto to_E = [&](const math::Three<S>& v) {
    return math::Three<S>{cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
  };
  const math::Three<double> p_HO{p_EO_.x(), p_EO_.y(), p_EO_.z() + shape_->length()};
  const math::Three<double> by_turn{-p_EO_.y(), p_EO_.x(), 0.0};  // velocity of O for the turn's rate 1
  const math::ThreeByThree<double> I = math::three_by_three(inertia_E_);
  const math::Three<S> w_H = to_E(h.w_B), alpha_H = to_E(h.alpha_B);
  const math::Three<S> w{w_H.x, w_H.y, w_H.z + rate};
  const math::Three<S> alpha{alpha_H.x + rate * w_H.y, alpha_H.y - rate * w_H.x, alpha_H.z};
  const math::Three<S> a =
      to_E(h.a_B) + math::cross(alpha_H, p_HO) + math::cross(w_H, math::cross(w_H, p_HO) + (2.0 * rate) * by_turn);
  const math::Three<S> Iw = I * w;
  if (loaded_) {
    moment += dot(to_E(math::transposed(h.R_WB, math::three(external_W_.force))), by_turn) +
              math::transposed(h.R_WB, math::three(external_W_.moment)).z;
  }
  moment -= body_.mass * dot(a, by_turn) + (I * alpha).z + w.x * Iw.y - w.y * Iw.x;
  return moment * (1.0 / (I.z.z + body_.mass * dot(by_turn, by_turn)));
}

template <int n, typename S>
SPRING_WORKBENCH_INLINE void HeldBody::accelerate(const S& t, const motion::FrameForcing<S>& h, const S* q,
                                                  const S* q_dot, S* q_ddot) const {
  S q_all[rod::max_strain_coordinates]{}, q_dot_all[rod::max_strain_coordinates]{},
      q_ddot_all[rod::max_strain_coordinates];
  S springs[n];
  for (int i = 0; i < n; ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    q_all[c] = q[i];
    q_dot_all[c] = q_dot[i];
    springs[i] = -K_[c] * q[i] - D_[c] * q_dot[i];
  }
  if (modal_) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) springs[i] -= D_modal_(i, j) * q_dot[j];
    }
  }
  if constexpr (n == 1) {
    if (returning_ == 0) {
      const bool stretch = active_[0] == shape_->stretch().begin;
      const double per_unit = 1.0 / axial_unit_;
      const S x = axial_unit_ * q[0], force = per_unit * springs[0];
      q_ddot[0] = per_unit * (stretch ? slide(h, x, force) : turn(h, x, S(axial_unit_ * q_dot[0]), force));
      return;
    }
  }
  if (returning_ > 0) {
    for (S& x : q_ddot_all) x = S{};
    for (int k = 0; k < math::lanes<S>; ++k) prescribe(math::lane(t, k), k, q_all, q_dot_all, q_ddot_all);
  }
  rod::TipOf<S> tip;
  shape_->tip(q_all, q_dot_all, tip);
  const Rigid<S> rigid = without_strain_acceleration(h, tip, q_dot_all, q_ddot_all);

  if constexpr (n == 6) {
    if (tip.separate) {
      // Newton and Euler for the body under the tip's wrench, then back to the coordinates: no mass matrix.
      const math::Three<S> force{springs[0], springs[1], springs[5]};
      const math::Three<S> moment_E =
          math::transposed(tip.inverse_angular, math::Three<S>{springs[2], springs[3], springs[4]});
      const math::Three<S> a_O = (1.0 / body_.mass) * (force - rigid.force);
      const math::Three<S> moment_O =
          math::transposed(rigid.R_HO, moment_E - math::cross(rigid.r_EO, force)) - rigid.moment_O;
      const math::Three<S> alpha = rigid.R_HO * (math::three_by_three(inverse_inertia_O_) * moment_O);
      const math::Three<S> a_E = a_O - math::cross(alpha, rigid.r_EO);
      const math::Three<S> turn = tip.inverse_angular * alpha;
      q_ddot[0] = a_E.x;
      q_ddot[1] = a_E.y;
      q_ddot[2] = turn.x;
      q_ddot[3] = turn.y;
      q_ddot[4] = turn.z;
      q_ddot[5] = a_E.z;
      return;
    }
  }
  math::Three<S> linear[n], angular[n], momentum[n];  // of O: axes of H and of O
  const math::ThreeByThree<double> I = math::three_by_three(body_.inertia_O);
  for (int i = 0; i < n; ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
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
}

template <int n>
Eigen::Matrix<double, n, 1> HeldBody::acceleration(const HandleForcing& h, const Eigen::Matrix<double, n, 1>& q,
                                                   const Eigen::Matrix<double, n, 1>& q_dot) const {
  const motion::FrameForcing<double> forcing{math::three_by_three(h.X_WH.linear()), math::three(h.angular_velocity),
                                             math::three(h.angular_acceleration),
                                             math::three(h.acceleration_less_gravity)};
  Eigen::Matrix<double, n, 1> q_ddot;
  accelerate<n>(h.t, forcing, q.data(), q_dot.data(), q_ddot.data());
  return q_ddot;
}

template <int n>
SPRING_WORKBENCH_WIDE void HeldBody::acceleration(const HandleForcings& h, const math::Pack* q, const math::Pack* q_dot,
                                                  math::Pack* q_ddot) const {
  accelerate<n>(h.t, h.of_H, q, q_dot, q_ddot);
}

template Eigen::Matrix<double, 1, 1> HeldBody::acceleration<1>(const HandleForcing&, const Eigen::Matrix<double, 1, 1>&,
                                                               const Eigen::Matrix<double, 1, 1>&) const;
template void HeldBody::acceleration<1>(const HandleForcings&, const math::Pack*, const math::Pack*, math::Pack*) const;
template Eigen::Matrix<double, 2, 1> HeldBody::acceleration<2>(const HandleForcing&, const Eigen::Matrix<double, 2, 1>&,
                                                               const Eigen::Matrix<double, 2, 1>&) const;
template void HeldBody::acceleration<2>(const HandleForcings&, const math::Pack*, const math::Pack*, math::Pack*) const;
template Eigen::Matrix<double, 3, 1> HeldBody::acceleration<3>(const HandleForcing&, const Eigen::Matrix<double, 3, 1>&,
                                                               const Eigen::Matrix<double, 3, 1>&) const;
template void HeldBody::acceleration<3>(const HandleForcings&, const math::Pack*, const math::Pack*, math::Pack*) const;
template Eigen::Matrix<double, 4, 1> HeldBody::acceleration<4>(const HandleForcing&, const Eigen::Matrix<double, 4, 1>&,
                                                               const Eigen::Matrix<double, 4, 1>&) const;
template void HeldBody::acceleration<4>(const HandleForcings&, const math::Pack*, const math::Pack*, math::Pack*) const;
template Eigen::Matrix<double, 5, 1> HeldBody::acceleration<5>(const HandleForcing&, const Eigen::Matrix<double, 5, 1>&,
                                                               const Eigen::Matrix<double, 5, 1>&) const;
template void HeldBody::acceleration<5>(const HandleForcings&, const math::Pack*, const math::Pack*, math::Pack*) const;
template Eigen::Matrix<double, 6, 1> HeldBody::acceleration<6>(const HandleForcing&, const Eigen::Matrix<double, 6, 1>&,
                                                               const Eigen::Matrix<double, 6, 1>&) const;
template void HeldBody::acceleration<6>(const HandleForcings&, const math::Pack*, const math::Pack*, math::Pack*) const;

rod::StrainVector HeldBody::acceleration(const HandleForcing& h, const rod::StrainVector& q,
                                         const rod::StrainVector& q_dot) const {
  const auto of = [&](auto size) -> rod::StrainVector {
    constexpr int n = decltype(size)::value;
    return acceleration<n>(h, Eigen::Matrix<double, n, 1>(q), Eigen::Matrix<double, n, 1>(q_dot));
  };
  switch (size()) {
    case 1:
      return of(std::integral_constant<int, 1>());
    case 2:
      return of(std::integral_constant<int, 2>());
    case 3:
      return of(std::integral_constant<int, 3>());
    case 4:
      return of(std::integral_constant<int, 4>());
    case 5:
      return of(std::integral_constant<int, 5>());
    case 6:
      return of(std::integral_constant<int, 6>());
    default:
      return rod::StrainVector::Zero(0);
  }
}

motion::MotionState HeldBody::object(const HandleForcing& h, const StrainState& state,
                                     const rod::StrainVector* q_ddot) const {
  double q[rod::max_strain_coordinates]{}, rate[rod::max_strain_coordinates]{},
      acceleration[rod::max_strain_coordinates]{};
  for (int i = 0; i < size(); ++i) {
    const int c = active_[static_cast<std::size_t>(i)];
    q[c] = state.q[i];
    rate[c] = state.q_dot[i];
    if (q_ddot != nullptr) acceleration[c] = (*q_ddot)[i];
  }
  if (returning_ > 0) prescribe(h.t, 0, q, rate, acceleration);
  rod::TipOf<double> tip;
  shape_->tip(q, rate, tip);
  // Of the tip, in the turning frame H.
  math::Three<double> w = math::none<double>(), v = w, alpha = tip.angular_bias, a = tip.linear_bias;
  add_tip_motion(tip, shape_size_, rate, w, v);
  if (q_ddot != nullptr) add_tip_motion(tip, shape_size_, acceleration, alpha, a);
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
