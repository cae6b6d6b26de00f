#include "spring_workbench/rod/tip_fit.h"

#include <limits>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/square_system.h"

namespace spring_workbench::rod {
namespace {

constexpr int n = max_strain_coordinates;
constexpr int most_iterations = 60;
/// Newton's method converges quadratically: a last change of this size, of the rod's length or a radian, leaves none.
constexpr double last_change = 3e-8;
/// So far the pose is approached at once, of the rod's length or in radians: each pose on the way is near the last.
constexpr double farthest = 0.5;

/// The rotation vector of each lane.
template <typename S>
math::Three<S> log_of(const math::ThreeByThree<S>& R) {
  math::Three<S> theta{};
  for (int i = 0; i < math::lanes<S>; ++i) math::set_lane(theta, i, math::three(math::log_so3(math::matrix(R, i))));
  return theta;
}

/// `a bᵀ`.
template <typename S>
math::ThreeByThree<S> times_transposed(const math::ThreeByThree<S>& a, const math::ThreeByThree<S>& b) {
  return {b.x.x * a.x + b.y.x * a.y + b.z.x * a.z, b.x.y * a.x + b.y.y * a.y + b.z.y * a.z,
          b.x.z * a.x + b.y.z * a.y + b.z.z * a.z};
}

/// The tip's Jacobian, its velocities over the rod's length.
template <typename S>
math::SquareSystem<n, S> jacobian(const TipOf<S>& tip, double length) {
  const double per_length = 1.0 / length;
  S columns[n][n];
  for (int j = 0; j < n; ++j) {
    const math::Three<S>&v = tip.linear[j], &w = tip.angular[j];
    const S column[n] = {per_length * v.x, per_length * v.y, per_length * v.z, w.x, w.y, w.z};
    for (int i = 0; i < n; ++i) columns[j][i] = column[i];
  }
  return math::SquareSystem<n, S>(columns);
}

}  // namespace

template <typename S>
TipFit<S>::TipFit(const ShapeModel& shape, const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE,
                  const math::Three<S>& v_HE, const math::Three<S>& w_HE, const S* start)
    : length_(shape.length()) {
  for (int i = 0; i < n; ++i) {
    q[i] = start[i];
    q_dot[i] = S{};
  }
  find_strain(shape, R_HE, p_HE);
  const double per_length = 1.0 / length_;
  const S velocity[n] = {per_length * v_HE.x, per_length * v_HE.y, per_length * v_HE.z, w_HE.x, w_HE.y, w_HE.z};
  jacobian(tip_, length_).solve(velocity, q_dot);
}

template <typename S>
void TipFit<S>::find_strain(const ShapeModel& shape, const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE) {
  const S zero[n] = {};
  if (shape.strain_is_pose()) {
    const math::Three<S> phi = log_of(R_HE);
    const S strain[n] = {p_HE.x, p_HE.y, phi.x, phi.y, phi.z, p_HE.z - length_};
    for (int i = 0; i < n; ++i) q[i] = strain[i];
    return shape.tip(q, zero, tip_);
  }
  shape.tip(q, zero, tip_);
  const double per_length = 1.0 / length_;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const math::Three<S> p = per_length * (p_HE - tip_.p_HE), theta = log_of(times_transposed(R_HE, tip_.R_HE));
    const S squared = dot(p, p) + dot(theta, theta);
    S part = S{} + 1.0;
    for (int i = 0; i < math::lanes<S>; ++i) {
      const double distance = std::sqrt(math::lane(squared, i));
      if (distance > farthest) math::set_lane(part, i, farthest / distance);
    }
    const S missing[n] = {part * p.x, part * p.y, part * p.z, part * theta.x, part * theta.y, part * theta.z};
    S change[n];
    jacobian(tip_, length_).solve(missing, change);
    for (int i = 0; i < n; ++i) q[i] += change[i];
    shape.tip(q, zero, tip_);
    if (!(math::largest(squared) > last_change * last_change)) return;
  }
  for (int i = 0; i < n; ++i) q[i] = S{} + std::numeric_limits<double>::quiet_NaN();
  shape.tip(q, zero, tip_);
}

template <typename S>
void TipFit<S>::wrench(const S (&generalised)[max_strain_coordinates], math::Three<S>& force,
                       math::Three<S>& moment) const {
  S scaled[n];
  jacobian(tip_, length_).solve_transposed(generalised, scaled);
  force = (1.0 / length_) * math::Three<S>{scaled[0], scaled[1], scaled[2]};
  moment = {scaled[3], scaled[4], scaled[5]};
}

template struct TipFit<double>;
template struct TipFit<math::Pack>;

}  // namespace spring_workbench::rod
