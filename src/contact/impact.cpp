#include "impact.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::contact {
namespace {

/// Velocity of a row's point of a body that moves by `motion` [velocity; angular velocity] at its centre.
Vector3d at_point(const Vector6d& motion, const ContactRow& row) {
  return motion.head<3>() + motion.tail<3>().cross(row.lever_W);
}

/// What contacts give back of the impulses `rows` that have ended their approach and left the body with velocity `v`:
/// each its share of its normal impulse (Poisson's law), and the friction that takes the most energy. Unlike Newton's
/// law, that returns at most what was lost; of several different shares it may be more: then all give back less.
std::vector<ContactRow> given_back(const Matrix6d& mobility, const Vector6d& v, const std::vector<double>& shares,
                                   const std::vector<ContactRow>& rows) {
  std::vector<ContactRow> back = rows;
  for (std::size_t i = 0; i < back.size(); ++i) back[i].load_W *= shares[i];
  Vector6d motion = v + mobility * to_vector(total_load(back));
  for (int iteration = 0; iteration < most_sweeps; ++iteration) {
    double largest = 0.0, change = 0.0;
    for (ContactRow& row : back) {
      const Vector3d& n = row.point.n_W;
      Eigen::Matrix<double, 3, 6> to_point;
      to_point << Matrix3d::Identity(), -math::skew(row.lever_W);
      const Matrix3d across = Matrix3d::Identity() - n * n.transpose();
      const double yields = (across * to_point * mobility * to_point.transpose() * across).trace();
      const double normal = row.load_W.dot(n);
      if (!(yields > 0.0) || !(normal > 0.0)) continue;
      Vector3d tangential = across * (row.load_W - at_point(motion, row) / yields);
      tangential *= std::min(1.0, row.friction * normal / std::max(tangential.norm(), 1e-300));
      const Vector3d step = normal * n + tangential - row.load_W;
      motion += mobility * to_point.transpose() * step;
      row.load_W += step;
      largest = std::max(largest, row.load_W.norm());
      change = std::max(change, step.norm());
    }
    if (change <= small_change * largest) break;
  }
  const Vector6d lost = to_vector(total_load(rows)), gained = to_vector(total_load(back));
  const double energy = lost.dot(v) - 0.5 * lost.dot(mobility * lost);  // change by the approach, not above 0
  const double slope = gained.dot(v), curvature = gained.dot(mobility * gained);
  const double root = std::sqrt(std::max(0.0, slope * slope - 2.0 * curvature * energy));
  const double share = curvature > 0.0 ? std::clamp((root - slope) / curvature, 0.0, 1.0) : 1.0;
  for (ContactRow& row : back) row.load_W *= share;
  return back;
}

}  // namespace

Wrench impact(const Matrix6d& mobility, const Vector6d& v, std::vector<ContactRow>& contacts,
              const std::vector<double>& restitution, double h) {
  std::vector<double> gaps;
  for (const ContactRow& row : contacts) gaps.push_back(row.gap);
  const auto end_approach = [&](const Vector6d& motion, bool bounces) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      ContactRow& row = contacts[i];
      const Vector3d& n = row.point.n_W;
      const Vector3d at = at_point(motion, row);
      const double may_approach = bounces && restitution[i] > 0.0 ? 0.0 : std::max(0.0, gaps[i]) / h;
      row.load_W.setZero();
      row.slip_W = at - at.dot(n) * n;
      row.gap = at.dot(n) + may_approach;
    }
    solve_contacts(mobility, contacts);
    return total_load(contacts);
  };
  const Wrench stops = end_approach(v, true);
  if (*std::max_element(restitution.begin(), restitution.end()) == 0.0) return stops;
  const std::vector<ContactRow> stopped = contacts;
  const Vector6d still = v + mobility * to_vector(stops);
  const std::vector<ContactRow> back = given_back(mobility, still, restitution, stopped);
  end_approach(still + mobility * to_vector(total_load(back)), false);
  for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].load_W += stopped[i].load_W + back[i].load_W;
  return total_load(contacts);
}

}  // namespace spring_workbench::contact
