#include "bushing.h"

#include <cmath>

#include "spring_workbench/math/so3.h"

namespace spring_workbench {

StrainVector Bushing::stiffness(const PerFamily& k) const {
  const double slope = k.bend * length() * length() / 3.0;
  StrainVector K(6);
  K << k.bend, k.bend, slope, slope, k.torsion, k.stretch;
  return K;
}

void Bushing::tip(const StrainVector& q, const StrainVector& q_dot, TipKinematics& out) const {
  const Vector3d phi = q.segment<3>(2);
  const Vector3d phi_dot = q_dot.segment<3>(2);
  out.R_HE = exp_so3(phi);
  out.p_HE << q[0], q[1], length() + q[5];
  out.angular.setZero(3, 6);
  out.linear.setZero(3, 6);
  out.angular.middleCols<3>(2) = right_jacobian_so3(-phi);  // the left Jacobian: rates in the axes of H
  out.linear(0, 0) = out.linear(1, 1) = out.linear(2, 5) = 1.0;
  out.angular_bias = right_jacobian_rate_so3(-phi, -phi_dot, phi_dot);
  out.linear_bias.setZero();
}

RigidTransform Bushing::section(const StrainVector& q, double s) const {
  // No curve of its own: drawn as the cubic with the end positions and slopes, rotation spread evenly.
  const double u = s / length();
  const Matrix3d R = exp_so3(q.segment<3>(2));
  const Vector3d tip(q[0], q[1], length() + q[5]);
  const Vector3d t0 = length() * Vector3d::UnitZ();
  const Vector3d t1 = length() * R.col(2);
  RigidTransform X = RigidTransform::Identity();
  X.translation() = u * u * (3.0 - 2.0 * u) * tip + u * (1.0 - u) * ((1.0 - u) * t0 - u * t1);
  X.linear() = exp_so3(u * q.segment<3>(2));
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

bool Bushing::admissible(const StrainVector& q) const {
  constexpr double largest_angle = 6.0;  // [rad]; the coordinates are singular at a full turn
  return q.allFinite() && q.segment<3>(2).norm() < largest_angle;
}

}  // namespace spring_workbench
