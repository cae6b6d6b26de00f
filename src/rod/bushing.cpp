#include "bushing.h"

#include <cmath>

#include "spring_workbench/math/so3.h"

namespace spring_workbench {
namespace {

/// `p φ φᵀ + q I + r [φ]×`.
Matrix3d symmetric_and_skew(double p, double q, double r, const Vector3d& phi) {
  const double x = phi.x(), y = phi.y(), z = phi.z();
  const double px = p * x, py = p * y, pz = p * z, rx = r * x, ry = r * y, rz = r * z;
  Matrix3d m;
  m << px * x + q, px * y - rz, px * z + ry,  //
      px * y + rz, py * y + q, py * z - rx,   //
      px * z - ry, py * z + rx, pz * z + q;
  return m;
}

}  // namespace

StrainVector Bushing::stiffness(const PerFamily& k) const {
  const double slope = k.bend * length() * length() / 3.0;
  StrainVector K(6);
  K << k.bend, k.bend, slope, slope, k.torsion, k.stretch;
  return K;
}

void Bushing::tip(const StrainVector& q, const StrainVector& q_dot, TipKinematics& out) const {
  const Vector3d phi = q.segment<3>(2);
  const Vector3d phi_dot = q_dot.segment<3>(2);
  const So3Coefficients k = so3_coefficients(phi.squaredNorm());
  out.R_HE = exp_so3(phi, k);
  out.p_HE << q[0], q[1], length() + q[5];
  Eigen::Matrix<double, 3, 6> angular = Eigen::Matrix<double, 3, 6>::Zero(), linear = angular;
  // The left Jacobian, for rates in the axes of H: (1 − c θ²) I + b [φ]× + c φ φᵀ.
  angular.middleCols<3>(2) = symmetric_and_skew(k.c, 1.0 - k.c * phi.squaredNorm(), k.b, phi);
  linear(0, 0) = linear(1, 1) = linear(2, 5) = 1.0;
  out.angular = angular;
  out.linear = linear;
  // d/dt (left Jacobian) φ̇, where what is along φ̇ × φ̇ is none.
  const Vector3d s = phi.cross(phi_dot);
  const double t_dot = 2.0 * phi.dot(phi_dot);
  out.angular_bias = k.b_slope * t_dot * s + k.c_slope * t_dot * phi.cross(s) + k.c * phi_dot.cross(s);
  out.linear_bias.setZero();
  out.separate = true;
  out.inverse_angular = symmetric_and_skew(k.d, 1.0 - k.d * phi.squaredNorm(), -0.5, phi);
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
