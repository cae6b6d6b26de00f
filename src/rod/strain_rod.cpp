#include "strain_rod.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "constants.h"
#include "segment_rotation.h"
#include "spring_workbench/math/quadrature.h"

namespace spring_workbench::rod {
namespace {

template <int nodes>
const math::GaussLegendre<nodes>& rule() {
  static const math::GaussLegendre<nodes> gauss;
  return gauss;
}

}  // namespace

StrainRod::StrainRod(double length, int bend_terms) : ShapeModel(length), bend_terms_(bend_terms) {}

StrainVector StrainRod::units() const {
  StrainVector units = StrainVector::Constant(size(), 1.0 / length());
  units[stretch().begin] = 1.0;
  return units;
}

StrainVector StrainRod::stiffness(const PerDof& k) const {
  const double L = length();
  // A constant curvature cannot match the cantilever's linear one; with L³/4 small tip deflections agree.
  const double EI = k.bend * L * L * L / (bend_terms_ == 1 ? 4.0 : 3.0);
  StrainVector K(size());
  for (int axis = 0; axis < 2; ++axis) {
    for (int term = 0; term < bend_terms_; ++term) K[axis * bend_terms_ + term] = EI * L / (2 * term + 1);
  }
  K[torsion().begin] = k.torsion * L * L;
  K[stretch().begin] = k.stretch * L * L;
  return K;
}

template <typename S>
SPRING_WORKBENCH_INLINE StrainRod::LinearStrain<S> StrainRod::curvature(const S* q) const {
  if (bend_terms_ == 1) return {{q[0], q[1], q[2]}, math::zero<S>()};
  const double per_length = 2.0 / length();
  return {{q[0], q[2], q[4]}, {per_length * q[1], per_length * q[3], S{}}};
}

template <typename S>
SPRING_WORKBENCH_INLINE double StrainRod::turned_angle(const LinearStrain<S>& k) const {
  return length() * (std::sqrt(math::largest(dot(k.value, k.value))) +
                     0.5 * length() * std::sqrt(math::largest(dot(k.slope, k.slope))));
}

template <typename S>
SPRING_WORKBENCH_INLINE double StrainRod::wave(const LinearStrain<S>& k, double angle) const {
  return std::sqrt(angle * angle + 4.0 * length() * length() * std::sqrt(math::largest(dot(k.slope, k.slope))));
}

int StrainRod::segments(double angle) const {  // NaN gives the maximum, like an angle that is too large
  return 1 + static_cast<int>(std::min(max_turning, angle) / angle_per_segment);
}

template <int nodes, typename S>
SPRING_WORKBENCH_INLINE void StrainRod::integrate(const S* q, const S* q_dot, int count, double angle,
                                                  TipOf<S>& out) const {
  const LinearStrain<S> k = curvature(q), k_dot = curvature(q_dot);
  const S stretched = 1.0 + q[stretch().begin], stretching = q_dot[stretch().begin];
  const double h = length() / count;
  const math::GaussLegendre<nodes>& gauss = rule<nodes>();
  const math::Vec3<S> zero = math::zero<S>();

  // Integrals from the handle to the start of the segment, finally to the tip. Velocities in H axes.
  QuaternionOf<S> turned{zero, S{} + 1.0};
  math::Vec3<S> p = zero;  // ∫ d3 (position at unit stretch)
  math::Vec3<S> w = zero;  // ∫ R k̇
  // Moments about the handle, which are shifted to the tip at the end: ∫ f × (p_tip − p) = (∫ f) × p_tip − ∫ f × p.
  // Order: d1 and d2, the same times σ = −1 … 1 along the rod, d3.
  math::Vec3<S> f[5] = {zero, zero, zero, zero, zero};          // ∫ P_j R e
  math::Vec3<S> f_cross_p[5] = {zero, zero, zero, zero, zero};  // ∫ P_j R e × p
  math::Vec3<S> bias = zero;                                    // ∫ w × R k̇
  math::Vec3<S> bias_cross_p = zero;                            // ∫ (w × R k̇) × p
  math::Vec3<S> centripetal = zero;                             // ∫ w × (w × d3)
  math::Vec3<S> coriolis = zero;                                // ∫ w × d3

  for (int segment = 0; segment < count; ++segment) {
    const double s_begin = segment * h;
    const SegmentRotation<S> rotation(h * (k.value + (s_begin + 0.5 * h - 0.5 * length()) * k.slope), (h * h) * k.slope,
                                      angle / count);
    const auto ends = rotation.at(0.5);
    const QuaternionOf<S> to_middle = turned * conjugate(ends.before);
    math::Mat3x3<S> R[nodes];
    for (int i = 0; i < (nodes + 1) / 2; ++i) {
      const auto both = rotation.at(0.5 - gauss.nodes[i]);
      R[i] = rotation_matrix(to_middle * both.before);
      R[nodes - 1 - i] = rotation_matrix(to_middle * both.after);
    }
    turned = to_middle * ends.after;
    math::Vec3<S> rates[nodes];
    for (int i = 0; i < nodes; ++i) {
      rates[i] = R[i] * (k_dot.value + (s_begin + gauss.nodes[i] * h - 0.5 * length()) * k_dot.slope);
    }

    math::Vec3<S> p_rise = zero, w_rise = zero;
    for (int i = 0; i < nodes; ++i) {
      const double weight = h * gauss.weights[i];
      const double sigma = 2.0 * (s_begin + gauss.nodes[i] * h) / length() - 1.0;
      math::Vec3<S> p_i = p, w_i = w;
      for (int j = 0; j < nodes; ++j) {
        const double part = h * gauss.cumulative(i, j);
        p_i += part * R[j].z;
        w_i += part * rates[j];
      }
      p_rise += weight * R[i].z;
      w_rise += weight * rates[i];
      const math::Vec3<S> d1 = weight * R[i].x, d2 = weight * R[i].y, d3 = weight * R[i].z;
      const math::Vec3<S> m1 = cross(d1, p_i), m2 = cross(d2, p_i);
      f[0] += d1;
      f[1] += d2;
      f_cross_p[0] += m1;
      f_cross_p[1] += m2;
      if (bend_terms_ == 2) {
        f[2] += sigma * d1;
        f[3] += sigma * d2;
        f_cross_p[2] += sigma * m1;
        f_cross_p[3] += sigma * m2;
      }
      f[4] += d3;
      f_cross_p[4] += cross(d3, p_i);
      const math::Vec3<S> turning = weight * cross(w_i, rates[i]);
      bias += turning;
      bias_cross_p += cross(turning, p_i);
      const math::Vec3<S> w_cross_d3 = cross(w_i, d3);
      coriolis += w_cross_d3;
      centripetal += cross(w_i, w_cross_d3);
    }
    p += p_rise;
    w += w_rise;
  }

  out.R_HE = rotation_matrix(normalised(turned));
  out.p_HE = stretched * p;
  const auto set = [&](int c, int i) {
    out.angular[c] = f[i];
    out.linear[c] = stretched * (cross(f[i], p) - f_cross_p[i]);
  };
  for (int axis = 0; axis < 2; ++axis) {
    for (int term = 0; term < bend_terms_; ++term) set(axis * bend_terms_ + term, axis + 2 * term);
  }
  set(torsion().begin, 4);
  out.angular[stretch().begin] = zero;
  out.linear[stretch().begin] = p;
  out.angular_bias = bias;
  out.linear_bias = stretched * (cross(bias, p) - bias_cross_p + centripetal) + (2.0 * stretching) * coriolis;
}

template <typename S>
SPRING_WORKBENCH_INLINE void StrainRod::tip_of(const S* q, const S* q_dot, TipOf<S>& out) const {
  const LinearStrain<S> k = curvature(q);
  const double angle = turned_angle(k);
  const double most = wave(k, angle);
  if (most < wave_of_five) return integrate<5>(q, q_dot, 1, angle, out);
  if (most < wave_of_six) return integrate<6>(q, q_dot, 1, angle, out);
  return integrate<max_nodes>(q, q_dot, segments(angle), angle, out);
}

SPRING_WORKBENCH_WIDE void StrainRod::one_tip(const double* q, const double* q_dot, TipOf<double>& out) const {
  tip_of(q, q_dot, out);
}
void StrainRod::tip(const double* q, const double* q_dot, TipOf<double>& out) const { one_tip(q, q_dot, out); }
SPRING_WORKBENCH_WIDE void StrainRod::tips(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const {
  tip_of(q, q_dot, out);
}
void StrainRod::tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const { tips(q, q_dot, out); }

double StrainRod::extension(const StrainVector& q) const { return q[stretch().begin] * length(); }

double StrainRod::torsion_angle(const StrainVector& q) const { return q[torsion().begin] * length(); }

RigidTransform StrainRod::section(const StrainVector& q, double s) const {
  const LinearStrain<double> k = curvature(q.data());
  const math::GaussLegendre<max_nodes>& gauss = rule<max_nodes>();
  const double angle = turned_angle(k) * s / length();
  const int count = segments(angle);
  const double h = s / count;
  QuaternionOf<double> turned{math::zero<double>(), 1.0};
  math::Vec3<double> p = math::zero<double>();
  for (int segment = 0; segment < count; ++segment) {
    const SegmentRotation<double> rotation(h * (k.value + ((segment + 0.5) * h - 0.5 * length()) * k.slope),
                                           (h * h) * k.slope, angle / count);
    const auto ends = rotation.at(0.5);
    const QuaternionOf<double> to_middle = turned * conjugate(ends.before);
    for (int i = 0; i < max_nodes / 2; ++i) {
      const auto both = rotation.at(0.5 - gauss.nodes[i]);
      p += (h * gauss.weights[i]) *
           (rotation_matrix(to_middle * both.before).z + rotation_matrix(to_middle * both.after).z);
    }
    turned = to_middle * ends.after;
  }
  return make_transform((1.0 + q[stretch().begin]) * vector(p),
                        Quaterniond(turned.w, turned.v.x, turned.v.y, turned.v.z));
}

double StrainRod::range_used(const StrainVector& q) const {
  return std::max(-q[stretch().begin] / (1.0 - min_stretch), turned_angle(curvature(q.data())) / max_turning);
}

}  // namespace spring_workbench::rod
