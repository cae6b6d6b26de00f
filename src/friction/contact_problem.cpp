#include "spring_workbench/friction/contact_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "constants.h"
#include "joint_solution.h"
#include "reduced_contacts.h"

namespace spring_workbench::friction {

struct ContactProblem::Implementation {
  ReducedContacts contacts;
  JointSolution joint;
};

ContactProblem::ContactProblem() : implementation_(std::make_unique<Implementation>()) {}
ContactProblem::~ContactProblem() = default;

void ContactProblem::clear() { implementation_->contacts.clear(); }

std::size_t ContactProblem::add_body(const Eigen::Ref<const Eigen::MatrixXd>& response) {
  return implementation_->contacts.add_body(response);
}

std::size_t ContactProblem::add_contact(double friction, const Eigen::Vector3d& motion, const Eigen::Vector3d& load) {
  return implementation_->contacts.add_contact(friction, motion, load);
}

void ContactProblem::add_part(std::size_t body, const Eigen::Ref<const Eigen::Matrix3Xd>& jacobian) {
  implementation_->contacts.add_part(body, jacobian);
}

ContactProblem::Result ContactProblem::solve(double share, double enough) {
  ReducedContacts& contacts = implementation_->contacts;
  Result result;
  const double largest = contacts.prepare();
  const double wanted = std::clamp(share * largest, 1e-3 * enough, 0.1 * enough);
  enough = std::max(wanted, std::min(enough, sufficient_share * largest));
  const bool many = contacts.bodies().size() > max_bodies_finely;
  double before = std::numeric_limits<double>::infinity();
  for (bool go_on = true; go_on;) {
    ++result.iterations;
    result.residual = contacts.iterate();
    if (result.residual <= wanted) return result;
    if (result.iterations % check_iterations != 0) continue;
    go_on = result.residual < worthwhile_reduction * before;
    before = result.residual;
  }
  result.residual = contacts.residual();
  if (!(result.residual < std::numeric_limits<double>::infinity())) {
    contacts.set_loads(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * contacts.contacts().size())));
  } else if (const double target = many ? enough : wanted; result.residual > target) {
    implementation_->joint.improve(contacts, target, enough, result);
  }
  return result;
}

Eigen::Vector3d ContactProblem::load(std::size_t contact) const {
  const ReducedContacts::Contact& c = implementation_->contacts.contacts()[contact];
  return c.scale * c.load;
}

Eigen::VectorXd ContactProblem::change(std::size_t body) const { return implementation_->contacts.change(body); }

}  // namespace spring_workbench::friction
