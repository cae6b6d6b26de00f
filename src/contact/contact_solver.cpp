#include "spring_workbench/contact/contact_solver.h"

#include <algorithm>
#include <map>

#include "constants.h"
#include "contact_rows.h"
#include "spring_workbench/friction/contact_problem.h"
#include "spring_workbench/math/friction_cones.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::contact {
namespace {

/// Keeps the load inside its friction cone: presses only, and tangential ≤ μ normal.
Vector3d into_cone(const Vector3d& load, const Vector3d& n, double friction) {
  const double normal = load.dot(n);
  if (normal <= 0.0) return Vector3d::Zero();
  const Vector3d tangential = load - normal * n;
  const double size = tangential.norm();
  const double most = friction * normal;
  return size <= most ? load : Vector3d(normal * n + tangential * (most / size));
}

/// Axes [normal, across, across] of a contact, and the motion of its point along them per motion of the body.
struct Axes {
  Matrix3d axes;
  Eigen::Matrix<double, 3, 6> to_point;

  explicit Axes(const ContactRow& row) {
    const Vector3d& normal = row.point.n_W;
    const Vector3d across = normal.unitOrthogonal();
    axes << normal, across, normal.cross(across);
    to_point << axes.transpose(), -axes.transpose() * math::skew(row.lever_W);
  }
};

/// All contacts at once, for which the iterations, which have moved the body by `motion` so far, would take too long.
void solve_at_once(const Matrix6d& compliance, const Vector6d& motion, std::vector<ContactRow>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd to_points(3 * n, 6);
  Eigen::VectorXd x(3 * n), y(3 * n);
  std::vector<double> friction;
  std::vector<Axes> axes;
  for (const ContactRow& row : rows) {
    const auto first = 3 * static_cast<Eigen::Index>(axes.size());
    const Axes& a = axes.emplace_back(row);
    to_points.middleRows<3>(first) = a.to_point;
    x.segment<3>(first) = a.axes.transpose() * row.load_W;
    y.segment<3>(first) = a.axes.transpose() * row.slip_W + row.gap * Vector3d::UnitX();
    friction.push_back(row.friction);
  }
  const Eigen::MatrixXd A = to_points * (0.5 * (compliance + compliance.transpose())) * to_points.transpose();
  y += to_points * motion;
  if (!math::solve_in_cones(A, y - A * x, friction, x)) return;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].load_W = axes[i].axes * x.segment<3>(3 * static_cast<Eigen::Index>(i));
  }
}

/// The same problem with compliant materials: the surface between the body and each other one is a body without mass.
void solve_with_materials(const Matrix6d& compliance, std::vector<ContactRow>& rows) {
  friction::ContactProblem problem;
  const Matrix6d C = 0.5 * (compliance + compliance.transpose());
  const std::size_t body = problem.add_body(C);
  std::map<std::size_t, std::size_t> surfaces;
  for (const ContactRow& row : rows) {
    if (row.compliance > 0.0 && surfaces.count(row.point.other) == 0)
      surfaces[row.point.other] = problem.add_body(row.compliance * Matrix3d::Identity());
  }
  const Vector6d by_assumed = C * to_vector(total_load(rows));
  std::vector<Axes> axes;
  for (const ContactRow& row : rows) {
    const Axes& a = axes.emplace_back(row);
    const Vector3d motion = a.axes.transpose() * row.slip_W + (row.gap - indentation(rows, row)) * Vector3d::UnitX();
    problem.add_contact(row.friction, motion - a.to_point * by_assumed, a.axes.transpose() * row.load_W);
    problem.add_part(body, a.to_point);
    if (row.compliance > 0.0)
      problem.add_part(surfaces[row.point.other], Vector3d::UnitX() * row.point.n_W.transpose());
  }
  problem.solve(small_change, 0.1 * touching);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].load_W = axes[i].axes * problem.load(i);
}

}  // namespace

void solve_contacts(const Matrix6d& compliance, std::vector<ContactRow>& rows) {
  if (std::any_of(rows.begin(), rows.end(), [](const ContactRow& row) { return row.compliance > 0.0; })) {
    solve_with_materials(compliance, rows);
    return;
  }
  // How each row's point answers to a force there, and how the body does.
  struct Response {
    Matrix3d point;
    Eigen::Matrix<double, 6, 3> body;
    double normal = 0.0, tangential = 0.0;
    bool complies = false;
  };
  std::vector<Response> responses;
  for (const ContactRow& row : rows) {
    Eigen::Matrix<double, 3, 6> to_point;
    to_point << Matrix3d::Identity(), -math::skew(row.lever_W);
    Response a;
    a.body = compliance * to_point.transpose();
    a.point = to_point * a.body;
    a.normal = row.point.n_W.dot(a.point * row.point.n_W);
    const double scale = a.point.trace();
    a.tangential = std::max(0.5 * (scale - a.normal), 1e-12 * scale);
    a.complies = scale > 0.0 && a.normal > 1e-12 * scale;
    responses.push_back(a);
  }
  // What the loads add to the body's motion beyond those assumed at the start.
  Vector6d motion = Vector6d::Zero();
  for (int iteration = 0; iteration < most_sweeps; ++iteration) {
    double largest = 0.0, change = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ContactRow& row = rows[i];
      const Response& a = responses[i];
      if (!a.complies) continue;
      const Vector3d& n = row.point.n_W;
      const Vector3d at_point = motion.head<3>() + motion.tail<3>().cross(row.lever_W);
      Vector3d load = row.load_W - (row.gap + n.dot(at_point)) / a.normal * n;
      if (row.friction > 0.0) {
        // One step against the slip that is left, then back into the cone.
        const Vector3d slip = row.slip_W + at_point + a.point * (load - row.load_W);
        load -= (slip - n * n.dot(slip)) / a.tangential;
      } else {
        load = n * n.dot(load);
      }
      load = into_cone(load, n, row.friction);
      const Vector3d step = load - row.load_W;
      motion += a.body * step;
      row.load_W = load;
      largest = std::max(largest, load.norm());
      change = std::max(change, step.norm());
    }
    if (change <= small_change * largest) return;
  }
  if (rows.size() <= most_at_once) solve_at_once(compliance, motion, rows);
}

Wrench total_load(const std::vector<ContactRow>& rows) {
  Wrench sum;
  for (const ContactRow& row : rows) {
    sum.force += row.load_W;
    sum.moment += row.lever_W.cross(row.load_W);
  }
  return sum;
}

}  // namespace spring_workbench::contact
