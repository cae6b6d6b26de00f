#include "contact_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "spring_workbench/math/so3.h"

namespace spring_workbench {
namespace {

constexpr int most_sweeps = 200;
constexpr double small_change = 1e-10;  ///< of the largest load: the sweeps end

Vector6d wrench_at_centre(const ContactRow& row, const Vector3d& force) {
  Vector6d w;
  w << force, row.lever_W.cross(force);
  return w;
}

/// Keeps the load inside its friction cone: presses only, and tangential ≤ μ normal.
Vector3d into_cone(const Vector3d& load, const Vector3d& n, double friction) {
  const double normal = load.dot(n);
  if (normal <= 0.0) return Vector3d::Zero();
  const Vector3d tangential = load - normal * n;
  const double size = tangential.norm();
  const double most = friction * normal;
  return size <= most ? load : Vector3d(normal * n + tangential * (most / size));
}

}  // namespace

void solve_contacts(const Matrix6d& compliance, std::vector<ContactRow>& rows) {
  // motion = what the load adds to the body's motion beyond the load assumed at the start.
  Vector6d motion = Vector6d::Zero();
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double largest = 0.0, change = 0.0;
    for (ContactRow& row : rows) {
      const Vector3d& n = row.point.n_W;
      const Vector3d at_point = motion.head<3>() + motion.tail<3>().cross(row.lever_W);
      Eigen::Matrix<double, 3, 6> to_point;
      to_point << Matrix3d::Identity(), -skew(row.lever_W);
      const Matrix3d W = to_point * compliance * to_point.transpose();
      const double gap = row.gap + n.dot(at_point);
      const double W_nn = n.dot(W * n);
      const double scale = W.trace();
      if (!(scale > 0.0) || W_nn < 1e-12 * scale) continue;  // nothing here can give way
      Vector3d load = row.load_W;
      load -= gap / W_nn * n;
      if (row.friction > 0.0) {
        // One step against the slip that is left, then back into the cone.
        const Vector3d slip = row.slip_W + at_point - n * n.dot(at_point) + (W * (load - row.load_W) - n * n.dot(W * (load - row.load_W)));
        const double W_tt = std::max(0.5 * (W.trace() - W_nn), 1e-12 * scale);
        load -= (slip - n * n.dot(slip)) / W_tt;
      } else {
        load = n * n.dot(load);
      }
      load = into_cone(load, n, row.friction);
      const Vector3d step = load - row.load_W;
      motion += compliance * wrench_at_centre(row, step);
      row.load_W = load;
      largest = std::max(largest, load.norm());
      change = std::max(change, step.norm());
    }
    if (change <= small_change * largest) return;
  }
}

Wrench total_load(const std::vector<ContactRow>& rows) {
  Wrench sum;
  for (const ContactRow& row : rows) {
    sum.force += row.load_W;
    sum.moment += row.lever_W.cross(row.load_W);
  }
  return sum;
}

}  // namespace spring_workbench
