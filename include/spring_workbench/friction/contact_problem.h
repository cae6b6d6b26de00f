#pragma once

#include <Eigen/Core>
#include <memory>

namespace spring_workbench::friction {

/// Contacts between bodies under Coulomb's law of friction: finds the loads that close no gap, press only, stay in
/// their friction cones, and oppose what slips. A body is its degrees of freedom and their response to a load; a
/// contact is how the motion of its point follows from them. The problem knows nothing else, so a rigid body, an object
/// on a fork and a chain of joints are the same to it. The unit of motion is the caller's, a displacement or a
/// velocity; the unit of loads belongs to it.
///
/// Three methods, each only if the one before leaves too large a residual: symmetric Gauss–Seidel iterations over the
/// contacts from the loads assumed [JAJ98]; the alternating direction method of multipliers on one sparse Cholesky
/// factor, with De Saxcé's shift and Anderson acceleration [DF98, BPC11, WN11]; Newton's method on the augmented
/// Lagrangian, nonsymmetric as friction is [AC91] (all in doc/model.md). The result is always in the cones. Loads
/// that do not solve the problem are taken only where the residual falls to 0.3 of that of the loads before: between
/// walls that leave no room they would grow with a penalty, and the residual would stall. The same problem gives the
/// same bits.
class ContactProblem {
 public:
  ContactProblem();
  ~ContactProblem();
  ContactProblem(const ContactProblem&) = delete;
  ContactProblem& operator=(const ContactProblem&) = delete;

  /// Removes all bodies and contacts.
  void clear();
  /// Adds a body and returns its index. `response` (n × n for n degrees of freedom, possibly none): change of its
  /// motion per load; symmetric, positive semidefinite.
  std::size_t add_body(const Eigen::Ref<const Eigen::MatrixXd>& response);
  /// Adds a contact and returns its index. `motion` [normal, across, across]: of its point without any load, relative
  /// to the other body if that moves, too; a gap is added to the first. `load`: where the search starts.
  std::size_t add_contact(double friction, const Eigen::Vector3d& motion, const Eigen::Vector3d& load);
  /// Lets the contact added last move by `jacobian` (3 × n) times the motion of a body, in addition to what other
  /// bodies contribute.
  void add_part(std::size_t body, const Eigen::Ref<const Eigen::Matrix3Xd>& jacobian);

  struct Result {
    /// Largest distance of a contact from its law, ‖λ − Π(λ − u/w)‖ w, in the unit of motion: λ is its load, u its
    /// motion with De Saxcé's shift, w a third of the trace of its response, Π the projection into its cone. Contacts
    /// that no load can move are not counted. Infinite if the problem is not finite; then all loads are zero.
    double residual = 0.0;
    int iterations = 0;  ///< of the first two methods
    int factors = 0;     ///< systems of equations that were factorised
  };
  /// Solves the problem to a residual of at most `enough` and 1 % of the largest motion without loads; to `share` of
  /// that motion, or a thousandth of `enough`, if a few iterations do it.
  Result solve(double share, double enough);

  Eigen::Vector3d load(std::size_t contact) const;
  /// Returns what the loads change of the motion of a body.
  Eigen::VectorXd change(std::size_t body) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace spring_workbench::friction
