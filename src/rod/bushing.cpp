#include "bushing.h"

#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::rod {

StrainVector Bushing::diagonal(const PerDof& per_dof, double slope) const {
  StrainVector of(6);
  of << per_dof.bend, per_dof.bend, slope, slope, per_dof.torsion, per_dof.stretch;
  return of;
}

StrainVector Bushing::units() const { return diagonal({length(), length(), 1.0}, 1.0); }

StrainVector Bushing::stiffness(const PerDof& k) const {
  return diagonal(k, slope_stiffness_ && k.bend > 0.0 ? *slope_stiffness_ : k.bend * length() * length() / 3.0);
}

StrainVector Bushing::damping(const PerDof& c, const PerDof& k) const {
  const bool set = slope_stiffness_ && k.bend > 0.0;
  return diagonal(c, set ? c.bend * (*slope_stiffness_ / k.bend) : c.bend * length() * length() / 3.0);
}

template <typename S>
SPRING_WORKBENCH_INLINE void Bushing::tip_of(const S* q, const S* q_dot, TipOf<S>& out) const {
  const math::Vec3<S> phi{q[2], q[3], q[4]}, phi_dot{q_dot[2], q_dot[3], q_dot[4]}, zero = math::zero<S>();
  const S t = dot(phi, phi), one = S{} + 1.0;
  const math::So3CoefficientsOf<S> k = math::so3_coefficients(t);
  out.R_HE = math::exp_so3(phi, k);
  out.p_HE = {q[0], q[1], q[5] + length()};
  // The left Jacobian, for rates in the axes of H: (1 − c θ²) I + b [φ]× + c φ φᵀ.
  const math::Mat3x3<S> J = math::symmetric_and_skew(k.c, S(1.0 - k.c * t), k.b, phi);
  out.angular[0] = out.angular[1] = out.angular[5] = zero;
  out.angular[2] = J.x;
  out.angular[3] = J.y;
  out.angular[4] = J.z;
  out.linear[0] = {one, S{}, S{}};
  out.linear[1] = {S{}, one, S{}};
  out.linear[2] = out.linear[3] = out.linear[4] = zero;
  out.linear[5] = {S{}, S{}, one};
  // d/dt (left Jacobian) φ̇; terms along φ̇ × φ̇ vanish.
  const math::Vec3<S> s = cross(phi, phi_dot);
  const S t_dot = 2.0 * dot(phi, phi_dot);
  out.angular_bias = (k.b_slope * t_dot) * s + (k.c_slope * t_dot) * cross(phi, s) + k.c * cross(phi_dot, s);
  out.linear_bias = zero;
}

SPRING_WORKBENCH_WIDE void Bushing::one_tip(const double* q, const double* q_dot, TipOf<double>& out) const {
  tip_of(q, q_dot, out);
}
void Bushing::tip(const double* q, const double* q_dot, TipOf<double>& out) const { one_tip(q, q_dot, out); }
SPRING_WORKBENCH_WIDE void Bushing::tips(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const {
  tip_of(q, q_dot, out);
}
void Bushing::tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const { tips(q, q_dot, out); }

RigidTransform Bushing::section(const StrainVector& q, double s) const {
  // The bushing has no curve: it is drawn as the cubic with its end positions and slopes, with evenly distributed
  // rotation.
  const double u = s / length();
  const Matrix3d R = math::exp_so3(q.segment<3>(2));
  const Vector3d tip(q[0], q[1], length() + q[5]);
  const Vector3d t0 = length() * Vector3d::UnitZ();
  const Vector3d t1 = length() * R.col(2);
  RigidTransform X = RigidTransform::Identity();
  X.translation() = u * u * (3.0 - 2.0 * u) * tip + u * (1.0 - u) * ((1.0 - u) * t0 - u * t1);
  X.linear() = math::exp_so3(u * q.segment<3>(2));
  return X;
}

bool Bushing::rechart(StrainVector& q, StrainVector& q_dot) const {
  const Vector3d phi = q.segment<3>(2), rate = q_dot.segment<3>(2);
  const double angle = phi.norm();
  if (!(angle > M_PI)) return false;
  // φ (1 − 2π/|φ|), and its derivative along φ̇.
  const double turn = 2.0 * M_PI / angle;
  q.segment<3>(2) = (1.0 - turn) * phi;
  q_dot.segment<3>(2) = (1.0 - turn) * rate + turn * phi.dot(rate) / (angle * angle) * phi;
  return true;
}

double Bushing::range_used(const StrainVector& q) const { return q.segment<3>(2).norm() / largest_angle; }

}  // namespace spring_workbench::rod
