#include "impact.h"

#include <algorithm>

#include "constants.h"
#include "contact_rows.h"
#include "spring_workbench/friction/bounce.h"

namespace spring_workbench::contact {
namespace {

/// What contacts give back of the impulses `stopped` that have ended their approach and changed the velocity `v` of the
/// body; added to `stopped`.
void apply_restitution(const Matrix6d& mobility, const Vector6d& v, const std::vector<double>& shares,
                       std::vector<ContactRow>& stopped) {
  std::vector<friction::BouncingContact> contacts;
  std::vector<friction::BouncingContact*> all;
  for (std::size_t i = 0; i < stopped.size(); ++i) {
    const Matrix3d axes = axes_of(stopped[i]);
    const auto J = jacobian(axes, stopped[i]);
    contacts.push_back({0, 1, J, friction::BouncingContact::Jacobian::Zero(), J * v,
                        axes.transpose() * stopped[i].load_W, stopped[i].friction, shares[i]});
  }
  for (friction::BouncingContact& contact : contacts) all.push_back(&contact);
  std::vector<Vector6d> change{mobility * to_vector(total_load(stopped)), Vector6d::Zero()};
  friction::apply_restitution({mobility, Eigen::MatrixXd()}, all, change);
  for (std::size_t i = 0; i < stopped.size(); ++i) stopped[i].load_W = axes_of(stopped[i]) * contacts[i].impulse;
}

}  // namespace

Wrench impact(friction::ContactProblem& problem, const Matrix6d& mobility, const Vector6d& v,
              std::vector<ContactRow>& contacts, const std::vector<double>& restitution, double h) {
  std::vector<double> gaps;
  for (const ContactRow& row : contacts) gaps.push_back(row.gap);
  const auto end_approach = [&](const Vector6d& motion, bool bounces) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      ContactRow& row = contacts[i];
      const Vector3d& n = row.point.n_W;
      const Vector3d at_point = motion.head<3>() + motion.tail<3>().cross(row.lever_W);
      const double may_approach = bounces && restitution[i] > 0.0 ? 0.0 : std::max(0.0, gaps[i]) / h;
      row.load_W.setZero();
      row.slip_W = at_point - at_point.dot(n) * n;
      row.gap = at_point.dot(n) + may_approach;
    }
    solve_contacts(problem, mobility, touching / h, contacts);
  };
  end_approach(v, true);
  if (*std::max_element(restitution.begin(), restitution.end()) > 0.0) {
    std::vector<ContactRow> bounced = contacts;
    apply_restitution(mobility, v, restitution, bounced);
    end_approach(v + mobility * to_vector(total_load(bounced)), false);
    for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].load_W += bounced[i].load_W;
  }
  return total_load(contacts);
}

}  // namespace spring_workbench::contact
