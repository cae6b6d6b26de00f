#pragma once

#include <array>

#include "spring_workbench/math/rigid_transform.h"

// Arithmetic on several numbers at once, which only makes built-in methods fast: users of the interface with `double`
// can ignore it. Code that is written once for a scalar `S` works for `double` and for `Pack`.

/// Declares a function on packs that is inlined into its caller, whatever processor the caller is compiled for.
#define SPRING_WORKBENCH_INLINE inline __attribute__((always_inline))

/// Compiles a function twice: for any processor, and for processors with AVX and FMA, which hold a pack in one
/// register. The choice is made at program start. The function must be free or non-virtual and take packs by reference.
/// A build that defines this macro as nothing has only the first version, and the same digits on all processors.
#if defined(SPRING_WORKBENCH_WIDE)
#elif defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 11 && !defined(__clang__) && !defined(__AVX2__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SPRING_WORKBENCH_WIDE __attribute__((target_clones("default", "fma")))
#else
#define SPRING_WORKBENCH_WIDE
#endif

namespace spring_workbench::math {

/// A pack: four numbers in one register or in two. Each number is a lane.
using Pack = double __attribute__((vector_size(32)));
constexpr int pack_size = 4;  ///< number of lanes of a Pack

/// Makes a pack of these numbers.
SPRING_WORKBENCH_INLINE Pack pack(const std::array<double, 4>& x) { return Pack{x[0], x[1], x[2], x[3]}; }

/// Returns lane `i` of a pack, 0 … 3.
SPRING_WORKBENCH_INLINE double lane(const Pack& p, int i) { return p[i]; }
/// Returns the only lane of a number, which is the number itself.
SPRING_WORKBENCH_INLINE double lane(double x, int) { return x; }
/// Number of lanes of `S`: 4 for Pack, 1 for double.
template <typename S>
constexpr int lanes = sizeof(S) / sizeof(double);

/// Sets lane `i` of a pack.
SPRING_WORKBENCH_INLINE void set_lane(Pack& p, int i, double x) { p[i] = x; }
/// Sets the only lane of a number.
SPRING_WORKBENCH_INLINE void set_lane(double& p, int, double x) { p = x; }
/// Returns the largest lane.
template <typename S>
SPRING_WORKBENCH_INLINE double largest(const S& p) {
  double result = lane(p, 0);
  for (int i = 1; i < lanes<S>; ++i) result = lane(p, i) > result ? lane(p, i) : result;
  return result;
}

/// Returns the sum of all lanes. The order of the additions is the same on every processor.
SPRING_WORKBENCH_INLINE double sum(const Pack& p) { return (p[0] + p[1]) + (p[2] + p[3]); }

/// A vector of three coordinates.
template <typename S>
struct Vec3 {
  S x;  ///< coordinate along x
  S y;  ///< coordinate along y
  S z;  ///< coordinate along z
};
/// The zero vector.
template <typename S>
SPRING_WORKBENCH_INLINE Vec3<S> zero() {
  return {S{}, S{}, S{}};
}
/// Converts a vector from Eigen.
SPRING_WORKBENCH_INLINE Vec3<double> vec3(const Vector3d& v) { return {v[0], v[1], v[2]}; }
/// Converts a vector to Eigen.
SPRING_WORKBENCH_INLINE Vector3d vector(const Vec3<double>& v) { return {v.x, v.y, v.z}; }
/// Converts lane `i` of a vector to Eigen.
template <typename S>
SPRING_WORKBENCH_INLINE Vector3d vector(const Vec3<S>& v, int i) {
  return {lane(v.x, i), lane(v.y, i), lane(v.z, i)};
}

/// Sets lane `i` of a vector.
template <typename S>
SPRING_WORKBENCH_INLINE void set_lane(Vec3<S>& p, int i, const Vec3<double>& v) {
  set_lane(p.x, i, v.x);
  set_lane(p.y, i, v.y);
  set_lane(p.z, i, v.z);
}

/// Sum, lane by lane.
template <typename S, typename T>
SPRING_WORKBENCH_INLINE auto operator+(const Vec3<S>& a, const Vec3<T>& b) -> Vec3<decltype(a.x + b.x)> {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
/// Difference, lane by lane.
template <typename S, typename T>
SPRING_WORKBENCH_INLINE auto operator-(const Vec3<S>& a, const Vec3<T>& b) -> Vec3<decltype(a.x - b.x)> {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// Adds `b` to `a`, lane by lane.
template <typename S, typename T>
SPRING_WORKBENCH_INLINE Vec3<S>& operator+=(Vec3<S>& a, const Vec3<T>& b) {
  a.x += b.x;
  a.y += b.y;
  a.z += b.z;
  return a;
}
/// Product with a number, lane by lane.
template <typename T, typename S>
SPRING_WORKBENCH_INLINE auto operator*(const T& f, const Vec3<S>& a) -> Vec3<decltype(f * a.x)> {
  return {f * a.x, f * a.y, f * a.z};
}
/// Scalar product, lane by lane.
template <typename S, typename T>
SPRING_WORKBENCH_INLINE auto dot(const Vec3<S>& a, const Vec3<T>& b) -> decltype(a.x * b.x) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// Cross product, lane by lane.
template <typename S, typename T>
SPRING_WORKBENCH_INLINE auto cross(const Vec3<S>& a, const Vec3<T>& b) -> Vec3<decltype(a.x * b.x)> {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A 3 × 3 matrix by its columns.
template <typename S>
struct Mat3x3 {
  Vec3<S> x;  ///< first column
  Vec3<S> y;  ///< second column
  Vec3<S> z;  ///< third column
};
/// Converts a matrix from Eigen.
SPRING_WORKBENCH_INLINE Mat3x3<double> mat3x3(const Matrix3d& m) {
  return {vec3(m.col(0)), vec3(m.col(1)), vec3(m.col(2))};
}
/// Converts lane `i` of a matrix to Eigen.
template <typename S>
SPRING_WORKBENCH_INLINE Matrix3d matrix(const Mat3x3<S>& m, int i) {
  Matrix3d r;
  r << vector(m.x, i), vector(m.y, i), vector(m.z, i);
  return r;
}
/// Sets lane `i` of a matrix.
template <typename S>
SPRING_WORKBENCH_INLINE void set_lane(Mat3x3<S>& p, int i, const Mat3x3<double>& m) {
  set_lane(p.x, i, m.x);
  set_lane(p.y, i, m.y);
  set_lane(p.z, i, m.z);
}

/// Product of matrix and vector, lane by lane.
template <typename S, typename T>
SPRING_WORKBENCH_INLINE auto operator*(const Mat3x3<S>& m, const Vec3<T>& v) -> Vec3<decltype(m.x.x * v.x)> {
  return v.x * m.x + v.y * m.y + v.z * m.z;
}
/// Product `mᵀ v` of the transposed matrix and a vector, lane by lane.
template <typename S, typename T>
SPRING_WORKBENCH_INLINE auto transposed(const Mat3x3<S>& m, const Vec3<T>& v) -> Vec3<decltype(m.x.x * v.x)> {
  return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}
/// Product of matrices, lane by lane.
template <typename S, typename T>
SPRING_WORKBENCH_INLINE auto operator*(const Mat3x3<S>& a, const Mat3x3<T>& b) -> Mat3x3<decltype(a.x.x * b.x.x)> {
  return {a * b.x, a * b.y, a * b.z};
}
/// Returns the matrix `p v vᵀ + q I + r [v]×`, lane by lane.
template <typename S>
SPRING_WORKBENCH_INLINE Mat3x3<S> symmetric_and_skew(const S& p, const S& q, const S& r, const Vec3<S>& v) {
  const Vec3<S> pv = p * v, rv = r * v;
  const S xy = pv.x * v.y, xz = pv.x * v.z, yz = pv.y * v.z;
  return {{pv.x * v.x + q, xy + rv.z, xz - rv.y},
          {xy - rv.z, pv.y * v.y + q, yz + rv.x},
          {xz + rv.y, yz - rv.x, pv.z * v.z + q}};
}

}  // namespace spring_workbench::math
