#include "spring_workbench/rod/tip_fit.h"

#include "constants.h"
#include "spring_workbench/math/singular_values.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/square_system.h"

namespace spring_workbench::rod {
namespace {

constexpr int n = max_strain_coordinates;

/// Rotation vector of each lane.
template <typename S>
math::Vec3<S> log_of(const math::Mat3x3<S>& R) {
  math::Vec3<S> theta{};
  for (int i = 0; i < math::lanes<S>; ++i) math::set_lane(theta, i, math::vec3(math::log_so3(math::matrix(R, i))));
  return theta;
}

/// The outer product `a bᵀ`.
template <typename S>
math::Mat3x3<S> times_transposed(const math::Mat3x3<S>& a, const math::Mat3x3<S>& b) {
  return {b.x.x * a.x + b.y.x * a.y + b.z.x * a.z, b.x.y * a.x + b.y.y * a.y + b.z.y * a.z,
          b.x.z * a.x + b.y.z * a.y + b.z.z * a.z};
}

/// The tip's Jacobian by columns, with linear velocities divided by the rod's length.
template <typename S>
struct Columns {
  S by[n][n];

  Columns(const TipOf<S>& tip, double length) {
    const double per_length = 1.0 / length;
    for (int j = 0; j < n; ++j) {
      const math::Vec3<S>&v = tip.linear[j], &w = tip.angular[j];
      const S column[n] = {per_length * v.x, per_length * v.y, per_length * v.z, w.x, w.y, w.z};
      for (int i = 0; i < n; ++i) by[j][i] = column[i];
    }
  }
};

/// Regularised inverse of the Jacobian of one rod: for singular values σ < σ₀, 1/σ is replaced by σ/σ₀², which goes to
/// zero.
class Slope {
 public:
  template <typename S>
  Slope(const Columns<S>& columns, int lane, double length) {
    // Coordinates scaled to curvatures times length; the last one, the stretch, is dimensionless.
    units_ << length, length, length, length, length, 1.0;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) J_(i, j) = math::lane(columns.by[j][i], lane) / units_[j];
    }
    svd_ = math::singular_values(J_);
    inverse_ =
        svd_.values.unaryExpr([](double s) { return s >= min_motion ? 1.0 / s : s / (min_motion * min_motion); });
  }
  Vector6d times(const Vector6d& x) const { return J_ * units_.cwiseProduct(x); }
  /// Strain rates for the given velocities, as far as the rod can follow them.
  Vector6d solve(const Vector6d& b) const {
    return (svd_.V * inverse_.cwiseProduct(svd_.U.transpose() * b)).cwiseQuotient(units_);
  }
  /// Transpose of solve(): forces from generalised forces.
  Vector6d solve_transposed(const Vector6d& b) const {
    return svd_.U * inverse_.cwiseProduct(svd_.V.transpose() * b.cwiseQuotient(units_));
  }

 private:
  Vector6d units_, inverse_;
  Matrix6d J_;
  math::SingularValues svd_;
};

template <typename S>
Vector6d lane_of(const S* x, int lane) {
  Vector6d of;
  for (int i = 0; i < n; ++i) of[i] = math::lane(x[i], lane);
  return of;
}
template <typename S>
void set_lane(S* x, int lane, const Vector6d& to) {
  for (int i = 0; i < n; ++i) math::set_lane(x[i], lane, to[i]);
}

/// Distance of the tip from a pose: relative to the rod's length, and in radians.
template <typename S>
struct PoseError {
  S by[n];
  S squared;

  PoseError(const TipOf<S>& tip, const math::Mat3x3<S>& R_HE, const math::Vec3<S>& p_HE, double length) {
    const math::Vec3<S> p = (1.0 / length) * (p_HE - tip.p_HE), theta = log_of(times_transposed(R_HE, tip.R_HE));
    squared = dot(p, p) + dot(theta, theta);
    const S all[n] = {p.x, p.y, p.z, theta.x, theta.y, theta.z};
    for (int i = 0; i < n; ++i) by[i] = all[i];
  }
  Vector6d vector() const { return Eigen::Map<const Vector6d>(by); }
  /// Fraction of it that is covered in one step.
  S part() const {
    S part = S{} + 1.0;
    for (int i = 0; i < math::lanes<S>; ++i) {
      const double distance = std::sqrt(math::lane(squared, i));
      if (distance > farthest) math::set_lane(part, i, farthest / distance);
    }
    return part;
  }
};

/// A strain within the range of the rod, with its tip and the distance from the requested pose.
struct Candidate {
  Vector6d q;
  TipOf<double> tip;
  PoseError<double> pose_error;

  Candidate(const ShapeModel& shape, const math::Mat3x3<double>& R_HE, const math::Vec3<double>& p_HE,
            const Vector6d& strain)
      : q(strain), tip(tip_of(shape, strain)), pose_error(tip, R_HE, p_HE, shape.length()) {}
  static TipOf<double> tip_of(const ShapeModel& shape, const Vector6d& q) {
    const double zero[n] = {};
    TipOf<double> tip{};
    shape.tip(q.data(), zero, tip);
    return tip;
  }
};

/// Shortens `change` such that the rod stays in its range. If the stretch leaves the range, only the stretch is limited
/// to its end; otherwise the change is halved until it fits.
bool stay_in_range(const ShapeModel& shape, const Vector6d& q, Vector6d& change) {
  for (int halving = 0; halving < max_fit_halvings; ++halving, change *= 0.5) {
    if (shape.admissible(q + change)) return true;
    const double whole = change[n - 1];
    double most = 1.0;
    change[n - 1] = 0.0;
    if (shape.admissible(q + change)) {
      for (double least = 0.0; most - least > to_the_end;) {
        const double middle = 0.5 * (least + most);
        change[n - 1] = middle * whole;
        (shape.admissible(q + change) ? least : most) = middle;
        if (most == middle) change[n - 1] = least * whole;
      }
      return true;
    }
    change[n - 1] = whole;
  }
  return false;
}

/// Moves `q` to the pose, or as close to it as the rod's range and Jacobian allow. Stays on one solution branch by
/// steps that are short enough for the Jacobian to predict the change. Returns the remaining squared distance.
double approach(const ShapeModel& shape, const math::Mat3x3<double>& R_HE, const math::Vec3<double>& p_HE,
                Vector6d& q) {
  Candidate at(shape, R_HE, p_HE, q);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const bool last = !(at.pose_error.squared > last_change * last_change);
    const Slope slope(Columns<double>(at.tip, shape.length()), 0, shape.length());
    Vector6d change = slope.solve(at.pose_error.part() * at.pose_error.vector());
    bool went = false, on = true;
    for (int halving = 0; halving < max_fit_halvings && !went; ++halving, change *= 0.5) {
      if (!stay_in_range(shape, at.q, change)) break;
      const Candidate next(shape, R_HE, p_HE, at.q + change);
      const Vector6d moves = slope.times(change);
      const double error = (next.pose_error.vector() - at.pose_error.vector() + moves).norm();
      went = last || (error <= max_nonlinearity * moves.norm() && next.pose_error.squared < at.pose_error.squared);
      on = moves.squaredNorm() > min_progress * min_progress * at.pose_error.squared;
      if (went) at = next;
    }
    if (!went || !on || last) break;
  }
  q = at.q;
  return at.pose_error.squared;
}

/// Fits on the solution branch of `start` or, if that fails, on that of the straight rod; returns the one closer to the
/// pose.
Vector6d fit(const ShapeModel& shape, const math::Mat3x3<double>& R_HE, const math::Vec3<double>& p_HE,
             const Vector6d& start) {
  Vector6d from_start = start, from_straight = Vector6d::Zero();
  if (!shape.admissible(from_start)) from_start.setZero();
  const double pose_error = approach(shape, R_HE, p_HE, from_start);
  if (pose_error <= last_change * last_change) return from_start;
  return approach(shape, R_HE, p_HE, from_straight) < pose_error ? from_straight : from_start;
}

}  // namespace

template <typename S>
TipFit<S>::TipFit(const ShapeModel& shape, const math::Mat3x3<S>& R_HE, const math::Vec3<S>& p_HE,
                  const math::Vec3<S>& v_HE, const math::Vec3<S>& w_HE, const S* start)
    : shape_(shape) {
  find_strain(R_HE, p_HE, start);
  const double L = shape.length(), per_length = 1.0 / L;
  const Columns<S> columns(tip, L);
  exact_ = math::SquareSystem<n, S>(columns.by);
  const S inverse_squared = exact_.inverse_norm_squared({L, L, L, L, L, 1.0});
  const S velocity[n] = {per_length * v_HE.x, per_length * v_HE.y, per_length * v_HE.z, w_HE.x, w_HE.y, w_HE.z};
  exact_.solve(velocity, q_dot);
  for (int l = 0; l < math::lanes<S>; ++l) {
    near_singular_[l] = !shape.strain_is_pose() && !(math::lane(inverse_squared, l) * min_motion * min_motion <= 1.0);
    if (near_singular_[l]) set_lane(q_dot, l, Slope(columns, l, L).solve(lane_of(velocity, l)));
  }
}

template <typename S>
void TipFit<S>::find_strain(const math::Mat3x3<S>& R_HE, const math::Vec3<S>& p_HE, const S* start) {
  const S zero[n] = {};
  if (shape_.strain_is_pose()) {
    const math::Vec3<S> phi = log_of(R_HE);
    const S strain[n] = {p_HE.x, p_HE.y, phi.x, phi.y, phi.z, p_HE.z - shape_.length()};
    for (int i = 0; i < n; ++i) q[i] = strain[i];
    return shape_.tip(q, zero, tip);
  }
  for (int i = 0; i < n; ++i) q[i] = start[i];
  shape_.tip(q, zero, tip);
  if (follow_slope(R_HE, p_HE)) return;
  for (int l = 0; l < math::lanes<S>; ++l) {
    const math::Mat3x3<double> R = math::mat3x3(math::matrix(R_HE, l));
    set_lane(q, l, fit(shape_, R, math::vec3(math::vector(p_HE, l)), lane_of(start, l)));
  }
  shape_.tip(q, zero, tip);
}

template <typename S>
bool TipFit<S>::follow_slope(const math::Mat3x3<S>& R_HE, const math::Vec3<S>& p_HE) {
  const S zero[n] = {};
  PoseError<S> pose_error(tip, R_HE, p_HE, shape_.length());
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const S part = pose_error.part();
    S missing[n], change[n];
    for (int i = 0; i < n; ++i) missing[i] = part * pose_error.by[i];
    math::SquareSystem<n, S>(Columns<S>(tip, shape_.length()).by).solve(missing, change);
    for (int i = 0; i < n; ++i) q[i] += change[i];
    shape_.tip(q, zero, tip);
    for (int l = 0; l < math::lanes<S>; ++l) {
      if (!shape_.admissible(lane_of(q, l))) return false;
    }
    if (!(math::largest(pose_error.squared) > last_change * last_change)) return true;
    const PoseError<S> next(tip, R_HE, p_HE, shape_.length());
    S error = S{};
    for (int i = 0; i < n; ++i) {
      const S e = next.by[i] - (1.0 - part) * pose_error.by[i];
      error += e * e;
    }
    for (int l = 0; l < math::lanes<S>; ++l) {
      const double moves = math::lane(part, l) * math::lane(part, l) * math::lane(pose_error.squared, l);
      const bool there = math::lane(pose_error.squared, l) <= last_change * last_change;
      if (!there && !(math::lane(error, l) <= max_nonlinearity * max_nonlinearity * moves)) return false;
    }
    pose_error = next;
  }
  return false;
}

template <typename S>
void TipFit<S>::wrench(const S (&generalised)[max_strain_coordinates], math::Vec3<S>& force,
                       math::Vec3<S>& moment) const {
  S scaled[n];
  exact_.solve_transposed(generalised, scaled);
  for (int l = 0; l < math::lanes<S>; ++l) {
    if (!near_singular_[l]) continue;
    const Slope slope(Columns<S>(tip, shape_.length()), l, shape_.length());
    set_lane(scaled, l, slope.solve_transposed(lane_of(generalised, l)));
  }
  force = (1.0 / shape_.length()) * math::Vec3<S>{scaled[0], scaled[1], scaled[2]};
  moment = {scaled[3], scaled[4], scaled[5]};
}

template struct TipFit<double>;
template struct TipFit<math::Pack>;

}  // namespace spring_workbench::rod
