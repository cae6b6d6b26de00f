#include "three_term_rod.h"

#include <algorithm>

#include "piece_rotation.h"
#include "spring_workbench/math/quadrature.h"

namespace spring_workbench::rod {
namespace {

constexpr double angle_per_piece = 2.5;  ///< [rad]; the quadrature is exact to 1e-10 there
constexpr double most_turned = 64.0;     ///< [rad]; a rod wound up further is refused
constexpr double least_stretch = 0.02;   ///< of the rest length; a rod compressed further is refused

using Strain = ThreeTermRod::Strain;
using Columns = Eigen::Matrix<double, 3, ThreeTermRod::size>;

constexpr int rule_nodes = 8;  ///< of the quadrature on a piece

const math::GaussLegendre<rule_nodes>& rule() {
  static const math::GaussLegendre<rule_nodes> gauss;
  return gauss;
}

/// Upper bound of the angle through which the rod is turned.
double turned_angle(const Strain& x) {
  return Vector3d(x[0], x[2], x[4]).norm() + Vector3d(x[1], x[3], 0.0).norm() + Vector3d(x[6], x[7], 0.0).norm();
}

/// Of NaN the most, as of what is too large.
int segments(double angle) { return 1 + static_cast<int>(std::min(most_turned, angle) / angle_per_piece); }

/// Second shifted Legendre polynomial over σ = 2 s − 1.
double legendre2(double sigma) { return 1.5 * sigma * sigma - 0.5; }

/// Rotation over the piece of length `h` whose middle is at `s`.
SegmentRotation<2, double> piece_rotation(const Strain& x, double s, double h) {
  const Vector3d mean(x[0], x[2], x[4]), first(x[1], x[3], 0.0), second(x[6], x[7], 0.0);
  const double sigma = 2.0 * s - 1.0;
  return SegmentRotation<2, double>({math::three(h * (mean + sigma * first + legendre2(sigma) * second)),
                                     math::three(2.0 * h * h * (first + 3.0 * sigma * second)),
                                     math::three(6.0 * h * h * h * second)});
}

/// Attitude at the nodes and, returned, at the end of a piece that starts at `begin`.
QuaternionOf<double> turned_at_nodes(const SegmentRotation<2, double>& rotation, const QuaternionOf<double>& begin,
                                     Matrix3d* R) {
  const auto ends = rotation.at(0.5);
  const QuaternionOf<double> to_middle = begin * conjugate(ends.before);
  for (int i = 0; i < rule_nodes / 2; ++i) {
    const auto both = rotation.at(0.5 - rule().nodes[i]);
    R[i] = math::matrix(rotation_matrix(to_middle * both.before), 0);
    R[rule_nodes - 1 - i] = math::matrix(rotation_matrix(to_middle * both.after), 0);
  }
  return to_middle * ends.after;
}

/// What each strain rate turns the section at `s` of attitude `R` by, over arc length.
Columns turning(const Matrix3d& R, double s) {
  const double sigma = 2.0 * s - 1.0, second = legendre2(sigma);
  Columns c;
  c << R.col(0), sigma * R.col(0), R.col(1), sigma * R.col(1), R.col(2), Vector3d::Zero(), second * R.col(0),
      second * R.col(1);
  return c;
}

}  // namespace

RigidTransform ThreeTermRod::section(const Strain& x, double s) {
  const int count = segments(turned_angle(x) * s);
  const double h = s / count;
  QuaternionOf<double> turned{math::none<double>(), 1.0};
  Vector3d p = Vector3d::Zero();
  for (int segment = 0; segment < count; ++segment) {
    Matrix3d R[nodes_per_segment];
    turned = turned_at_nodes(piece_rotation(x, (segment + 0.5) * h, h), turned, R);
    for (int i = 0; i < nodes_per_segment; ++i) p += h * rule().weights[i] * R[i].col(2);
  }
  const QuaternionOf<double> end = normalised(turned);
  return make_transform(Quaterniond(end.w, end.v.x, end.v.y, end.v.z), (1.0 + x[stretch]) * p);
}

bool ThreeTermRod::admissible(const Strain& x) {
  return x.allFinite() && 1.0 + x[stretch] > least_stretch && turned_angle(x) < most_turned;
}

ThreeTermRod::ThreeTermRod(const Strain& x) : stretched_(1.0 + x[stretch]), segments_(segments(turned_angle(x))) {
  const double h = 1.0 / segments_;
  QuaternionOf<double> turned{math::none<double>(), 1.0};
  Vector3d p = Vector3d::Zero();
  // Moments about the origin, shifted to the tip at the end: ∫ c × (p_tip − p) = (∫ c) × p_tip − ∫ c × p.
  Columns c_sum = Columns::Zero(), c_cross_p = Columns::Zero();
  for (int segment = 0; segment < segments_; ++segment) {
    Node* const nodes = nodes_ + nodes_per_segment * segment;
    Matrix3d R[nodes_per_segment];
    turned = turned_at_nodes(piece_rotation(x, (segment + 0.5) * h, h), turned, R);
    for (int i = 0; i < nodes_per_segment; ++i) nodes[i].R = R[i];
    Vector3d p_end = p;
    for (int i = 0; i < nodes_per_segment; ++i) {
      nodes[i].p = p;
      for (int j = 0; j < nodes_per_segment; ++j) nodes[i].p += h * rule().cumulative(i, j) * nodes[j].R.col(2);
      p_end += h * rule().weights[i] * nodes[i].R.col(2);
      const Columns c = h * rule().weights[i] * turning(nodes[i].R, (segment + rule().nodes[i]) * h);
      c_sum += c;
      for (int v = 0; v < size; ++v) c_cross_p.col(v) += c.col(v).cross(nodes[i].p);
    }
    p = p_end;
  }
  R_ = math::matrix(rotation_matrix(normalised(turned)), 0);
  p_ = stretched_ * p;
  for (int v = 0; v < size; ++v) J_.col(v) << stretched_ * (c_sum.col(v).cross(p) - c_cross_p.col(v)), c_sum.col(v);
  J_.col(stretch) << p, Vector3d::Zero();
}

ThreeTermRod::Matrix ThreeTermRod::load_stiffness(const Vector6& wrench) const {
  // Component v of Jᵀ wrench is ∫ c_v · m ds with the moment m at the section; x_u turns what is beyond s by φ_u = ∫
  // c_u and moves it by π_u = ∫ φ_u × d₃.
  const Vector3d force = stretched_ * wrench.head<3>();
  const Vector3d p_tip = p_ / stretched_;
  const Columns pi_tip = J_.topRows<3>() / stretched_;
  const double h = 1.0 / segments_;
  Matrix H = Matrix::Zero();
  Columns phi = Columns::Zero(), pi = Columns::Zero();
  for (int segment = 0; segment < segments_; ++segment) {
    const Node* const nodes = nodes_ + nodes_per_segment * segment;
    Columns c[nodes_per_segment], phi_at[nodes_per_segment], moved[nodes_per_segment];
    for (int i = 0; i < nodes_per_segment; ++i) c[i] = turning(nodes[i].R, (segment + rule().nodes[i]) * h);
    for (int i = 0; i < nodes_per_segment; ++i) {
      phi_at[i] = phi;
      for (int j = 0; j < nodes_per_segment; ++j) phi_at[i] += h * rule().cumulative(i, j) * c[j];
      for (int u = 0; u < size; ++u) moved[i].col(u) = phi_at[i].col(u).cross(nodes[i].R.col(2));
    }
    for (int i = 0; i < nodes_per_segment; ++i) {
      Columns rest = pi_tip - pi;
      for (int j = 0; j < nodes_per_segment; ++j) rest -= h * rule().cumulative(i, j) * moved[j];
      const Vector3d moment = wrench.tail<3>() + (p_tip - nodes[i].p).cross(force);
      Columns change;
      for (int u = 0; u < size; ++u) change.col(u) = moment.cross(phi_at[i].col(u)) + rest.col(u).cross(force);
      H.noalias() += (h * rule().weights[i] * c[i]).transpose().lazyProduct(change);
    }
    for (int i = 0; i < nodes_per_segment; ++i) {
      phi += h * rule().weights[i] * c[i];
      pi += h * rule().weights[i] * moved[i];
    }
  }
  H.col(stretch) = pi_tip.transpose() * wrench.head<3>();
  H.row(stretch) = H.col(stretch).transpose();
  H(stretch, stretch) = 0.0;
  return H;
}

}  // namespace spring_workbench::rod
