#include "spring_workbench/geometry/conservative_advancement.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::geometry {
namespace {

/// Returns the largest f ≤ `limit` up to which a + b f − ½ c f² is not negative; c ≥ 0.
double positive_until(double a, double b, double c, double limit) {
  if (a + limit * (b - 0.5 * c * limit) >= 0.0 && a >= 0.0) return limit;
  if (a <= 0.0) return 0.0;
  const double root = std::sqrt(b * b + 2.0 * c * a);
  return b < 0.0 ? 2.0 * a / (root - b) : (b + root) / c;
}

/// The separating plane moves with the box `own`; the corners are those of the other box.
double free_fraction_to_corners(const OutlineBox& own, const StraightMotion& motion, const OutlineBox& other,
                                const Vector3d& n_W, double tolerance, double limit) {
  const double lowest = n_W.dot(own.X.translation() - motion.p_WO) - reach(own, n_W);
  const Vector3d n_rate = motion.turn_W.cross(n_W);
  double clear = limit;
  for (const Vector3d& p : corners(other.half)) {
    const Vector3d corner = other.X * p;
    const Vector3d above = motion.p_WO - corner;
    const double furthest = above.norm() + limit * motion.move_W.norm();
    const double bend = n_rate.norm() * (motion.turn_W.norm() * furthest + 2.0 * motion.move_W.norm());
    clear =
        positive_until(n_W.dot(above) + lowest + tolerance, n_rate.dot(above) + n_W.dot(motion.move_W), bend, clear);
  }
  return clear;
}

}  // namespace

double free_fraction_above(const OutlineBox& own, const StraightMotion& motion, const HalfSpace& below,
                           double tolerance, double limit) {
  const double across = below.n_W.cross(motion.turn_W).norm();
  double clear = limit;
  for (const Vector3d& p : corners(own.half)) {
    const Vector3d corner = own.X * p;
    const Vector3d by_turning = motion.turn_W.cross(corner - motion.p_WO);
    const double height = below.n_W.dot(corner) - below.height;
    clear = positive_until(height + tolerance, below.n_W.dot(motion.move_W + by_turning), across * by_turning.norm(),
                           clear);
  }
  return clear;
}

double free_fraction_to(const OutlineBox& own, const StraightMotion& motion, const OutlineBox& other, double tolerance,
                        double limit) {
  const Vector3d n_W = gap_between(own, other).n_W;
  const double top = n_W.dot(other.X.translation()) + reach(other, n_W);
  const double clear = free_fraction_above(own, motion, {n_W, top}, tolerance, limit);
  if (clear >= limit) return clear;
  return std::max(clear, free_fraction_to_corners(own, motion, other, n_W, tolerance, limit));
}

double free_fraction_past(const OutlineBox& own, const StraightMotion& motion, const OutlineBox& other,
                          double tolerance, double limit) {
  double gone = 0.0;
  for (double advance = limit; advance > least_advance * limit && gone < limit; gone += advance) {
    const Matrix3d turned = math::exp_so3(gone * motion.turn_W);
    StraightMotion left = motion;
    left.p_WO += gone * motion.move_W;
    OutlineBox here = own;
    here.X.translation() = left.p_WO + turned * (own.X.translation() - motion.p_WO);
    here.X.linear() = turned * own.X.linear();
    advance = free_fraction_to(here, left, other, tolerance, limit - gone);
  }
  return std::min(gone, limit);
}

double StraightMotion::max_displacement(const Matrix3d& R_OW, const Vector3d& most_O) const {
  const Vector3d a = (R_OW * turn_W).cwiseAbs(), &r = most_O;
  const Vector3d arc(a.y() * r.z() + a.z() * r.y(), a.z() * r.x() + a.x() * r.z(), a.x() * r.y() + a.y() * r.x());
  return move_W.norm() + arc.norm();
}

StraightMotion straight_motion(const RigidTransform& X0_WO, const RigidTransform& X1_WO) {
  return {X0_WO.translation(), X1_WO.translation() - X0_WO.translation(),
          X0_WO.linear() * math::turn_between(X0_WO, X1_WO)};
}

}  // namespace spring_workbench::geometry
