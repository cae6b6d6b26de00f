#include "quadratic_rod.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

namespace spring_workbench::rod {
namespace {

using Vector6 = ThreeTermRod::Vector6;
using Matrix6 = ThreeTermRod::Matrix6;

constexpr int most_newton_steps = 12;
constexpr double newton_done = 1e-9;        ///< last change of r; the next one would be its square
constexpr double largest_condensed = 20.0;  ///< of r, curvature times length
constexpr double singular = 1e-9;           ///< of the six's Jacobian: at a full circle stretching moves nothing
constexpr double difference = 3e-3;         ///< for second derivatives along a motion, of fourth order

}  // namespace

/// Residual of the condensed coordinates' equilibrium, K₂ r − J₂ᵀ λ.
struct QuadraticRod::Balance {
  Balance(const Strain& K, const Strain& x) : rod(x) {
    const Matrix6 J6 = rod.jacobian().leftCols<6>();
    Eigen::CompleteOrthogonalDecomposition<Matrix6> held;
    held.setThreshold(singular);
    held.compute(J6.transpose());
    wrench = held.solve(Vector6(K.head<6>().cwiseProduct(x.head<6>())));
    residual = K.tail<2>().cwiseProduct(x.tail<2>()) - rod.jacobian().rightCols<2>().transpose() * wrench;
  }

  /// Derivative of the residual by x: only strains that leave the tip where it is count.
  Eigen::Matrix<double, 2, 8> derivative(const Strain& K) const {
    Eigen::CompleteOrthogonalDecomposition<Matrix6> held;
    held.setThreshold(singular);
    held.compute(rod.jacobian().leftCols<6>());
    const Eigen::Matrix<double, 6, 2> six = held.solve(Eigen::Matrix<double, 6, 2>(rod.jacobian().rightCols<2>()));
    ThreeTermRod::Matrix change = -rod.load_stiffness(wrench);
    change.diagonal() += K;
    return change.bottomRows<2>() - six.transpose() * change.topRows<6>();
  }

  ThreeTermRod rod;
  Vector6 wrench;
  Eigen::Vector2d residual;
};

QuadraticRod::QuadraticRod(double length, const PerDof& k) : ShapeModel(length) {
  const double bend = k.bend * length * length / 3.0;
  K_ << bend, bend / 3.0, bend, bend / 3.0, k.torsion, k.stretch * length * length, bend / 5.0, bend / 5.0;
}

StrainVector QuadraticRod::stiffness(const PerDof& k) const {
  const double L = length();
  const double bend = k.bend * L * L * L * L / 3.0;  // EI L
  StrainVector K(size());
  K << bend, bend / 3.0, bend, bend / 3.0, k.torsion * L * L, k.stretch * L * L;
  return K;
}

std::shared_ptr<const ShapeModel> QuadraticRod::for_stiffness(const PerDof& k) const {
  return std::make_shared<QuadraticRod>(length(), k);
}

QuadraticRod::Condensed QuadraticRod::condense(const StrainVector& q) const {
  Condensed c;
  c.x << length() * q.head<5>(), q[5], 0.0, 0.0;
  c.slope.setZero();
  c.inverse.setZero();
  if (!(K_[6] > 0.0)) return c;
  for (int i = 0; i < most_newton_steps; ++i) {
    const Balance balance(K_, c.x);
    const Eigen::Matrix<double, 2, 8> derivative = balance.derivative(K_);
    c.inverse = derivative.rightCols<2>().inverse();
    const Eigen::Vector2d change = c.inverse * balance.residual;
    c.slope = -c.inverse * derivative.leftCols<6>();
    c.x.tail<2>() -= change;
    if (!(c.x.tail<2>().norm() < largest_condensed)) break;
    if (change.norm() < newton_done) return c;
  }
  c.x.tail<2>().setZero();
  c.slope.setZero();
  c.inverse.setZero();
  c.found = false;
  return c;
}

double QuadraticRod::condensed_energy(const StrainVector& q) const {
  const Eigen::Vector2d r = condense(q).x.tail<2>();
  return 0.5 * r.dot(K_.tail<2>().cwiseProduct(r));
}

void QuadraticRod::tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const {
  out.separate = false;
  out.condensed = true;
  for (int k = 0; k < math::pack_size; ++k) {
    double q_k[6], q_dot_k[6];
    for (int i = 0; i < 6; ++i) {
      q_k[i] = q[i][k];
      q_dot_k[i] = q_dot[i][k];
    }
    TipOf<double> one;
    tip(q_k, q_dot_k, one);
    math::set_lane(out.R_HE, k, one.R_HE);
    math::set_lane(out.p_HE, k, one.p_HE);
    math::set_lane(out.angular_bias, k, one.angular_bias);
    math::set_lane(out.linear_bias, k, one.linear_bias);
    for (int i = 0; i < 6; ++i) {
      math::set_lane(out.angular[i], k, one.angular[i]);
      math::set_lane(out.linear[i], k, one.linear[i]);
      math::set_lane(out.condensed_force[i], k, one.condensed_force[i]);
    }
  }
}

void QuadraticRod::tip(const double* q_begin, const double* q_dot_begin, TipOf<double>& out) const {
  using Vector = Eigen::Matrix<double, 6, 1>;
  const Eigen::Map<const Vector> q_dot(q_dot_begin);
  const double L = length();
  const Condensed c = condense(Eigen::Map<const Vector>(q_begin));
  const ThreeTermRod rod(c.x);
  // Rows to metres; columns from strain times length to strain.
  const auto scaled = [L](Matrix6 J) {
    J.topRows<3>() *= L;
    J.leftCols<5>() *= L;
    return J;
  };
  const Eigen::Matrix<double, 6, 2> J2 = rod.jacobian().rightCols<2>();
  const Matrix6 J = scaled(rod.jacobian().leftCols<6>() + J2 * c.slope);
  out.R_HE = math::three_by_three(rod.rotation());
  out.p_HE = math::three(L * rod.position());
  Vector condensed_force = c.slope.transpose() * K_.tail<2>().cwiseProduct(c.x.tail<2>());
  condensed_force.head<5>() *= L;
  out.separate = false;
  out.condensed = true;
  for (int i = 0; i < 6; ++i) {
    out.linear[i] = math::three(J.block<3, 1>(0, i));
    out.angular[i] = math::three(J.block<3, 1>(3, i));
    out.condensed_force[i] = condensed_force[i];
  }
  out.linear_bias = out.angular_bias = math::none<double>();

  Strain x_dot;
  x_dot.head<6>() << L * q_dot.head<5>(), q_dot[5];
  x_dot.tail<2>() = c.slope * x_dot.head<6>();
  const double speed = x_dot.norm();
  if (!(speed > 0.0)) return;
  // Along x + t ẋ: the change of J ẋ, and what r̈ keeps the condensed coordinates in equilibrium.
  const Strain along = x_dot / speed;
  Vector6 velocity_change = Vector6::Zero();
  Eigen::Vector2d residual_curvature = Eigen::Vector2d::Zero();
  if (K_[6] > 0.0) residual_curvature = -2.5 * Balance(K_, c.x).residual;
  constexpr double first[] = {1.0 / 12.0, -2.0 / 3.0, 2.0 / 3.0, -1.0 / 12.0};
  constexpr double second[] = {-1.0 / 12.0, 4.0 / 3.0, 4.0 / 3.0, -1.0 / 12.0};
  constexpr double at[] = {-2.0, -1.0, 1.0, 2.0};
  for (int i = 0; i < 4; ++i) {
    const Balance moved(K_, c.x + difference * at[i] * along);
    velocity_change += first[i] * (moved.rod.jacobian() * along);
    residual_curvature += second[i] * moved.residual;
  }
  const Vector6 bias =
      speed * speed / difference * (velocity_change - J2 * (c.inverse * residual_curvature) / difference);
  out.linear_bias = math::three(L * bias.head<3>());
  out.angular_bias = math::three(bias.tail<3>());
}

RigidTransform QuadraticRod::section(const StrainVector& q, double s) const {
  RigidTransform X = ThreeTermRod::section(condense(q).x, s / length());
  X.translation() *= length();
  return X;
}

bool QuadraticRod::admissible(const StrainVector& q) const {
  if (!q.allFinite()) return false;
  Strain six;
  six << length() * q.head<5>(), q[5], 0.0, 0.0;
  if (!ThreeTermRod::admissible(six)) return false;
  const Condensed c = condense(q);
  return c.found && ThreeTermRod::admissible(c.x);
}

}  // namespace spring_workbench::rod
