#pragma once

#include "spring_workbench/math/pack.h"

namespace spring_workbench::rod {

/// A quaternion with vector part v and scalar part w, for one number or several at once.
template <typename S>
struct QuaternionOf {
  math::Vec3<S> v;
  S w;
};
template <typename S>
SPRING_WORKBENCH_INLINE QuaternionOf<S> operator*(const QuaternionOf<S>& a, const QuaternionOf<S>& b) {
  return {a.w * b.v + b.w * a.v + math::cross(a.v, b.v), a.w * b.w - dot(a.v, b.v)};
}
template <typename S>
SPRING_WORKBENCH_INLINE QuaternionOf<S> conjugate(const QuaternionOf<S>& q) {
  return {-1.0 * q.v, q.w};
}
/// One Newton step towards unit length, for quaternions that are off by rounding errors.
template <typename S>
SPRING_WORKBENCH_INLINE QuaternionOf<S> normalised(const QuaternionOf<S>& q) {
  const S f = 1.5 - 0.5 * (dot(q.v, q.v) + q.w * q.w);
  return {f * q.v, f * q.w};
}
template <typename S>
SPRING_WORKBENCH_INLINE math::Mat3x3<S> rotation_matrix(const QuaternionOf<S>& q) {
  return math::symmetric_and_skew(S(S{} + 2.0), S(1.0 - 2.0 * dot(q.v, q.v)), S(2.0 * q.w), q.v);
}

/// The rotation along a rod segment whose strain is linear in arc length, as a power series of its quaternion about the
/// middle. The series of q' = ½ q (a + b u) converges for every strain; for segments that turn by less than 2.5 rad,
/// its error is at most 1e-13.
template <typename S>
class SegmentRotation {
 public:
  /// The strain over the segment of length h is (a + b u) / h for u = −½ … ½. `angle`: a bound of |a| + |b| / 2 [rad].
  SPRING_WORKBENCH_INLINE SegmentRotation(const math::Vec3<S>& a, const math::Vec3<S>& b, double angle) {
    pairs_ = angle < 0.5 ? 7 : angle < 1.2 ? 8 : max_pairs;
    c_[0] = {math::zero<S>(), S{} + 1.0};
    c_[1] = {0.5 * a, S{}};
    for (int n = 1; n + 1 < 2 * pairs_; ++n) {
      const QuaternionOf<S> by_a = times(c_[n], a), by_b = times(c_[n - 1], b);
      const double f = 0.5 / (n + 1);
      c_[n + 1] = {f * (by_a.v + by_b.v), f * (by_a.w + by_b.w)};
    }
  }

  struct Two {
    QuaternionOf<S> before, after;
  };
  /// Rotations from the middle of the segment to −u and to u.
  SPRING_WORKBENCH_INLINE Two at(double u) const {
    const double t = u * u;
    QuaternionOf<S> even = c_[2 * pairs_ - 2], odd = c_[2 * pairs_ - 1];
    for (int n = pairs_ - 2; n >= 0; --n) {
      even = {c_[2 * n].v + t * even.v, c_[2 * n].w + t * even.w};
      odd = {c_[2 * n + 1].v + t * odd.v, c_[2 * n + 1].w + t * odd.w};
    }
    return {{even.v - u * odd.v, even.w - u * odd.w}, {even.v + u * odd.v, even.w + u * odd.w}};
  }

 private:
  static constexpr int max_pairs = 11;

  SPRING_WORKBENCH_INLINE static QuaternionOf<S> times(const QuaternionOf<S>& q, const math::Vec3<S>& v) {
    return {q.w * v + math::cross(q.v, v), S{} - dot(q.v, v)};
  }

  int pairs_;
  QuaternionOf<S> c_[2 * max_pairs];
};

}  // namespace spring_workbench::rod
