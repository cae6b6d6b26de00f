#include "strain_rod.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "piece_rotation.h"
#include "spring_workbench/math/quadrature.h"

namespace spring_workbench {
namespace {

constexpr int nodes_per_piece = 8;
constexpr double angle_per_piece = 2.5;  ///< [rad]; the quadrature is exact to 1e-10 there
constexpr double most_turned = 64.0;     ///< [rad]; a rod wound up further is refused
constexpr double least_stretch = 0.02;   ///< of the rest length; a rod compressed further is refused

const GaussLegendre<nodes_per_piece>& rule() {
  static const GaussLegendre<nodes_per_piece> gauss;
  return gauss;
}

}  // namespace

StrainRod::StrainRod(std::string name, double length, int bend_terms)
    : ShapeModel(length), name_(std::move(name)), bend_terms_(bend_terms) {}

StrainVector StrainRod::stiffness(const PerFamily& k) const {
  const double L = length();
  // One constant curvature cannot follow the cantilever's linear one: L³/4 makes small tip deflections agree.
  const double EI = k.bend * L * L * L / (bend_terms_ == 1 ? 4.0 : 3.0);
  StrainVector K(size());
  for (int axis = 0; axis < 2; ++axis) {
    for (int term = 0; term < bend_terms_; ++term) K[axis * bend_terms_ + term] = EI * L / (2 * term + 1);
  }
  K[torsion().begin] = k.torsion * L * L;
  K[stretch().begin] = k.stretch * L * L;
  return K;
}

StrainRod::LinearStrain StrainRod::curvature(const StrainVector& q) const {
  LinearStrain k;
  k.value << q[0], q[bend_terms_], q[torsion().begin];
  if (bend_terms_ == 2) k.slope << 2.0 / length() * q[1], 2.0 / length() * q[3], 0.0;
  return k;
}

double StrainRod::turned_angle(const LinearStrain& k) const {
  return length() * (k.value.norm() + 0.5 * length() * k.slope.norm());
}

int StrainRod::pieces(double angle) const {
  return 1 + static_cast<int>(std::min(angle, most_turned) / angle_per_piece);
}

void StrainRod::tip(const StrainVector& q, const StrainVector& q_dot, TipKinematics& out) const {
  using Nodes = Eigen::Matrix<double, 3, nodes_per_piece>;
  const LinearStrain k = curvature(q);
  const LinearStrain k_dot = curvature(q_dot);
  const double stretched = 1.0 + q[stretch().begin];
  const double stretching = q_dot[stretch().begin];
  const int count = pieces(turned_angle(k));
  const double h = length() / count;
  const GaussLegendre<nodes_per_piece>& gauss = rule();

  // Integrals from the handle to the start of the piece, then to the tip. Velocities in the axes of H.
  Quaterniond turned = Quaterniond::Identity();
  Vector3d p = Vector3d::Zero();            // ∫ d3 (position at unit stretch)
  Vector3d w = Vector3d::Zero();            // ∫ R k̇
  // Moments about the handle; they are shifted to the tip at the end: ∫ f × (p_tip − p) = (∫ f) × p_tip − ∫ f × p.
  StrainJacobian f = StrainJacobian::Zero(3, size());         // ∫ P_j R e
  StrainJacobian f_cross_p = StrainJacobian::Zero(3, size()); // ∫ P_j R e × p
  Vector3d bias = Vector3d::Zero();          // ∫ w × R k̇
  Vector3d bias_cross_p = Vector3d::Zero();  // ∫ (w × R k̇) × p
  Vector3d centripetal = Vector3d::Zero();   // ∫ w × (w × d3)
  Vector3d coriolis = Vector3d::Zero();      // ∫ w × d3

  for (int piece = 0; piece < count; ++piece) {
    const double s_begin = piece * h;
    Nodes d1, d2, d3, rates;
    const Vector3d middle = k.value + k.slope * (s_begin + 0.5 * h - 0.5 * length());
    const PieceRotation<1> rotation({h * middle, h * h * k.slope});
    for (int i = 0; i < nodes_per_piece; ++i) {
      const double s = gauss.nodes[i] * h;
      const Matrix3d R = (turned * rotation.at(gauss.nodes[i] - 0.5)).toRotationMatrix();
      d1.col(i) = R.col(0);
      d2.col(i) = R.col(1);
      d3.col(i) = R.col(2);
      rates.col(i) = R * (k_dot.value + k_dot.slope * (s_begin + s - 0.5 * length()));
    }
    turned = turned * rotation.at(0.5);

    const Eigen::Matrix<double, nodes_per_piece, nodes_per_piece> cumulative = h * gauss.cumulative;
    Nodes p_at, w_at;
    p_at.noalias() = d3 * cumulative.transpose();
    w_at.noalias() = rates * cumulative.transpose();
    for (int i = 0; i < nodes_per_piece; ++i) {
      const double weight = h * gauss.weights[i];
      const double sigma = 2.0 * (s_begin + gauss.nodes[i] * h) / length() - 1.0;
      const Vector3d p_i = p + p_at.col(i);
      const Vector3d w_i = w + w_at.col(i);
      const Vector3d d[2] = {weight * d1.col(i), weight * d2.col(i)};
      const Vector3d d3_i = weight * d3.col(i);
      for (int axis = 0; axis < 2; ++axis) {
        const Vector3d moment = d[axis].cross(p_i);
        const int c = axis * bend_terms_;
        f.col(c) += d[axis];
        f_cross_p.col(c) += moment;
        if (bend_terms_ == 2) {
          f.col(c + 1) += sigma * d[axis];
          f_cross_p.col(c + 1) += sigma * moment;
        }
      }
      f.col(torsion().begin) += d3_i;
      f_cross_p.col(torsion().begin) += d3_i.cross(p_i);
      const Vector3d turning = weight * w_i.cross(rates.col(i));
      bias += turning;
      bias_cross_p += turning.cross(p_i);
      const Vector3d w_cross_d3 = w_i.cross(d3_i);
      coriolis += w_cross_d3;
      centripetal += w_i.cross(w_cross_d3);
    }
    p += h * (d3 * gauss.weights);
    w += h * (rates * gauss.weights);
  }

  turned.normalize();
  out.R_HE = turned.toRotationMatrix();
  out.p_HE = stretched * p;
  out.angular = f;
  out.linear.resize(3, size());
  for (int c = 0; c < size() - 1; ++c) out.linear.col(c) = stretched * (f.col(c).cross(p) - f_cross_p.col(c));
  out.angular.col(stretch().begin).setZero();
  out.linear.col(stretch().begin) = p;
  out.angular_bias = bias;
  out.linear_bias =
      stretched * (bias.cross(p) - bias_cross_p + centripetal) + 2.0 * stretching * coriolis;
}

double StrainRod::extension(const StrainVector& q) const { return q[stretch().begin] * length(); }

double StrainRod::twist(const StrainVector& q) const { return q[torsion().begin] * length(); }

RigidTransform StrainRod::section(const StrainVector& q, double s) const {
  const LinearStrain k = curvature(q);
  const GaussLegendre<nodes_per_piece>& gauss = rule();
  const int count = pieces(turned_angle(k) * s / length());
  const double h = s / count;
  Quaterniond turned = Quaterniond::Identity();
  Vector3d p = Vector3d::Zero();
  for (int piece = 0; piece < count; ++piece) {
    const Vector3d middle = k.value + k.slope * ((piece + 0.5) * h - 0.5 * length());
    const PieceRotation<1> rotation({h * middle, h * h * k.slope});
    for (int i = 0; i < nodes_per_piece; ++i) {
      p += h * gauss.weights[i] * (turned * rotation.at(gauss.nodes[i] - 0.5) * Vector3d::UnitZ());
    }
    turned = turned * rotation.at(0.5);
  }
  return make_transform(turned, (1.0 + q[stretch().begin]) * p);
}

bool StrainRod::admissible(const StrainVector& q) const {
  return q.allFinite() && 1.0 + q[stretch().begin] > least_stretch && turned_angle(curvature(q)) < most_turned;
}

}  // namespace spring_workbench
