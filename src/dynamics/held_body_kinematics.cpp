// The motion of the object, and what follows from it, for given coordinates.
#include <Eigen/Cholesky>
#include <algorithm>

#include "equation_of_motion.h"
#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/rod/tip_motion.h"

namespace spring_workbench::dynamics {

const rod::TipOf<double>& HeldBody::tip(const double* q, const double* q_dot, bool needs_rates) const {
  const int n = coordinates_.count();
  LastTip& last = last_tip_;
  const bool same = last.known && std::equal(q, q + n, last.q.begin()) &&
                    (!needs_rates || std::equal(q_dot, q_dot + n, last.q_dot.begin()));
  if (same) return last.tip;
  std::copy_n(q, n, last.q.begin());
  std::copy_n(q_dot, n, last.q_dot.begin());
  find_tip(q, q_dot, last.tip);
  last.known = true;
  return last.tip;
}

HeldBody::Kinematics HeldBody::kinematics(const StrainState& full) const {
  const rod::TipOf<double>& of_tip = tip(full.q.data(), full.q_dot.data(), false);
  Kinematics k;
  const Matrix3d R_HE = math::matrix(of_tip.R_HE, 0);
  const math::Vec3<double> r_EO = of_tip.R_HE * math::vec3(p_EO_);
  k.R_HO = R_HE * R_EO_;
  k.linear.resize(3, full.q.size());
  k.angular.resize(3, full.q.size());
  for (Eigen::Index i = 0; i < full.q.size(); ++i) {
    k.linear.col(i) = math::vector(of_tip.linear[i] + math::cross(of_tip.angular[i], r_EO));
    k.angular.col(i) = math::vector(of_tip.angular[i]);
  }
  return k;
}

HeldBody::Kinematics HeldBody::kinematics(double t, const rod::StrainVector& q) const {
  return kinematics(full_state(t, {q, rod::StrainVector::Zero(size())}));
}

rod::StrainMatrix HeldBody::mass_matrix(const Kinematics& k, Matrix3d& I_H) const {
  I_H = k.R_HO * body_.inertia_O * k.R_HO.transpose();
  const int n = size();
  rod::StrainMatrix M(n, n);
  for (int j = 0; j < n; ++j) {
    const Vector3d momentum = body_.mass * k.linear.col(coordinates_[j]);
    const Vector3d angular_momentum = I_H * k.angular.col(coordinates_[j]);
    for (int i = 0; i <= j; ++i) {
      const int c = coordinates_[i];
      M(i, j) = M(j, i) = k.linear.col(c).dot(momentum) + k.angular.col(c).dot(angular_momentum);
    }
  }
  return M;
}

rod::StrainMatrix HeldBody::mass_matrix(double t, const rod::StrainVector& q) const {
  Matrix3d I_H;
  return mass_matrix(kinematics(t, q), I_H);
}

bool HeldBody::rechart(StrainState& state) const {
  if (returning()) return false;
  StrainState full = full_state(0.0, state);
  if (!shape_->rechart(full.q, full.q_dot)) return false;
  state = {coordinates_.gather(full.q), coordinates_.gather(full.q_dot)};
  return true;
}

rod::TwistJacobian HeldBody::object_jacobian(double t, const rod::StrainVector& q) const {
  const Kinematics k = kinematics(t, q);
  rod::TwistJacobian J(6, size());
  for (int i = 0; i < size(); ++i) J.col(i) << k.linear.col(coordinates_[i]), k.angular.col(coordinates_[i]);
  return J;
}

rod::StrainVector HeldBody::project_twist(const HandleState& h, const rod::StrainVector& q, const Twist& V_WO_W) const {
  if (size() == 0) return rod::StrainVector::Zero(0);
  const motion::MotionState carried = object(h, {q, rod::StrainVector::Zero(size())});
  const Kinematics k = kinematics(h.t, q);
  Matrix3d I_H;
  const rod::StrainMatrix M = mass_matrix(k, I_H);
  const auto R_HW = h.X_WH.linear().transpose();
  const Vector3d momentum = body_.mass * (R_HW * (V_WO_W.linear - carried.velocity.linear));
  const Vector3d angular_momentum = I_H * (R_HW * (V_WO_W.angular - carried.velocity.angular));
  const rod::StrainVector p =
      coordinates_.gather(k.linear.transpose() * momentum + k.angular.transpose() * angular_momentum);
  return M.llt().solve(p);
}

motion::MotionState HeldBody::object(const HandleState& h, const StrainState& state,
                                     const rod::StrainVector* q_ddot) const {
  double q[rod::max_strain_coordinates], rate[rod::max_strain_coordinates], acceleration[rod::max_strain_coordinates]{};
  coordinates_.scatter(state.q.data(), q);
  coordinates_.scatter(state.q_dot.data(), rate);
  if (q_ddot != nullptr) coordinates_.scatter(q_ddot->data(), acceleration);
  if (returning()) coordinates_.prescribe(h.t, 0, q, rate, acceleration);
  const rod::TipOf<double>& tip = this->tip(q, rate, q_ddot != nullptr);
  // Of the tip, in the turning frame H.
  math::Vec3<double> w = math::zero<double>(), v = w, alpha = tip.angular_bias, a = tip.linear_bias;
  rod::add_tip_motion(tip, coordinates_.count(), rate, w, v);
  if (q_ddot != nullptr) rod::add_tip_motion(tip, coordinates_.count(), acceleration, alpha, a);
  const math::Vec3<double> r_EO = tip.R_HE * math::vec3(p_EO_), p_HO = tip.p_HE + r_EO,
                           v_rel = v + math::cross(w, r_EO);
  const math::Vec3<double> w_H = math::vec3(h.w_WH_H), alpha_H = math::vec3(h.alpha_WH_H);
  const math::Mat3x3<double> R_WH = math::mat3x3(h.X_WH.linear());
  motion::MotionState s;
  s.X.linear() = math::matrix(R_WH * (tip.R_HE * math::mat3x3(R_EO_)), 0);
  s.X.translation() = h.X_WH.translation() + math::vector(R_WH * p_HO);
  s.velocity.linear = h.v_WH_W + math::vector(R_WH * (math::cross(w_H, p_HO) + v_rel));
  s.velocity.angular = math::vector(R_WH * (w_H + w));
  if (q_ddot != nullptr) {
    const math::Vec3<double> of_O = a + math::cross(alpha, r_EO) + math::cross(w, math::cross(w, r_EO));
    const math::Vec3<double> a_H = math::vec3(h.proper_acceleration_H) + of_O + math::cross(alpha_H, p_HO) +
                                   math::cross(w_H, math::cross(w_H, p_HO) + 2.0 * v_rel);
    s.acceleration.linear = math::vector(R_WH * a_H) - gravity_ * Vector3d::UnitZ();
    s.acceleration.angular = math::vector(R_WH * (alpha_H + math::cross(w_H, w) + alpha));
  }
  return s;
}

}  // namespace spring_workbench::dynamics
