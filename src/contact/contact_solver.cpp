#include "spring_workbench/contact/contact_solver.h"

#include <map>

#include "constants.h"
#include "contact_rows.h"

namespace spring_workbench::contact {

void solve_contacts(friction::ContactProblem& problem, const Matrix6d& response, double enough,
                    std::vector<ContactRow>& rows) {
  problem.clear();
  const Matrix6d symmetric = 0.5 * (response + response.transpose());
  const std::size_t body = problem.add_body(symmetric);
  const std::vector<double> depths = indentations(rows);
  const std::vector<std::size_t> surfaces = surfaces_of(rows);
  std::map<std::size_t, std::size_t> surface_bodies;  // of compliant materials: they have no mass
  const Vector6d by_assumed = symmetric * to_vector(total_load(rows));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ContactRow& row = rows[i];
    const Matrix3d axes = axes_of(row);
    const Eigen::Matrix<double, 3, 6> J = jacobian(axes, row);
    const Vector3d motion = axes.transpose() * row.slip_W + (row.gap - depths[i]) * Vector3d::UnitX();
    problem.add_contact(row.friction, motion - J * by_assumed, axes.transpose() * row.load_W);
    problem.add_part(body, J);
    if (!(row.compliance > 0.0)) continue;
    const auto [surface, is_new] = surface_bodies.try_emplace(surfaces[i]);
    if (is_new) surface->second = problem.add_body(row.compliance * Matrix3d::Identity());
    problem.add_part(surface->second, Vector3d::UnitX() * row.point.n_W.transpose());
  }
  problem.solve(load_share, enough);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].load_W = axes_of(rows[i]) * problem.load(i);
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
