#pragma once

#include "contact_factor.h"
#include "reduced_contacts.h"
#include "spring_workbench/friction/contact_problem.h"

namespace spring_workbench::friction {

/// All contacts of a problem solved together, for which iterations over them are too few.
class JointSolution {
 public:
  /// Improves the loads of `contacts`, whose residual is `result.residual`, until that is at most `enough`; down to
  /// `wanted` if it takes few alternations.
  void improve(ReducedContacts& contacts, double wanted, double enough, ContactProblem::Result& result);

 private:
  struct Alternation;
  /// Adds the contacts that are not open under the present loads to those that are solved. Returns whether there are
  /// any.
  bool activate();
  Eigen::VectorXd loads() const;
  void set_loads(const Eigen::VectorXd& loads);
  /// Takes the loads if they solve the problem better than the best so far, or, while none do, if their residual is
  /// much smaller: those of an infeasible problem grow with the penalty while it stalls. Returns their residual.
  double offer(const Eigen::VectorXd& loads);
  double target_residual(int alternation) const;
  bool factorize(double penalty);
  void alternate();
  Eigen::VectorXd direction(const Alternation& at, Eigen::VectorXd& reduced) const;
  bool adapt_penalty(Alternation& at, const Eigen::VectorXd& last_motion, const Eigen::VectorXd& reduced);

  /// Coulomb's law by Newton's method; the loads are what the penalty makes of what is missing, added to `loads_`.
  void linearise();
  Eigen::VectorXd newton_residual(const Eigen::VectorXd& reduced, Eigen::VectorXd& loads,
                                  std::vector<Eigen::Matrix3d>* slopes) const;
  bool iterate_newton(Eigen::VectorXd& reduced, Eigen::VectorXd& loads);

  template <typename Function>
  void each(const Function& function) const;

  ReducedContacts* contacts_ = nullptr;
  ContactProblem::Result* result_ = nullptr;
  double wanted_ = 0.0, enough_ = 0.0;
  std::vector<std::size_t> active_;  ///< indices of the contacts that are solved; all others are open
  Eigen::VectorXd best_;             ///< loads of these, as all that follow
  ContactFactor factor_;
  Eigen::VectorXd loads_;
  double penalty_ = 1.0;
};

}  // namespace spring_workbench::friction
