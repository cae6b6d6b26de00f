#pragma once

#include <Eigen/Core>
#include <memory>

namespace spring_workbench::friction {

/// Contacts between bodies under Coulomb's law of friction: finds loads that leave no penetration, only press, stay in
/// their friction cones, and oppose the slip. A body is given by its degrees of freedom and their response to a load; a
/// contact, by how the motion of its point depends on them. So a rigid body, an object on a fork and a chain of joints
/// are treated alike. The caller chooses the unit of motion, a displacement or a velocity; the unit of loads follows
/// from it.
///
/// Three methods are used, each only if the previous one leaves too large a residual: symmetric Gauss–Seidel iterations
/// over the contacts from the assumed loads [JAJ98]; the alternating direction method of multipliers on one sparse
/// Cholesky factor, with De Saxcé's shift and Anderson acceleration [DF98, BPC11, WN11]; Newton's method on the
/// augmented Lagrangian, which is nonsymmetric, as friction is [AC91] (references in doc/model.md). The resulting loads
/// always lie in the cones. Loads that do not solve the problem replace earlier ones only if they reduce the residual
/// to less than 0.3 of its value: between walls that leave no room, the loads would otherwise grow with the penalty
/// while the residual stalls. Equal problems have bit-identical solutions.
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
  /// Adds a contact and returns its index. `motion` [normal, tangent, tangent]: motion of its point without any load,
  /// relative to the other body if that moves, too, with the gap added to the normal component. `load`: initial guess.
  std::size_t add_contact(double friction, const Eigen::Vector3d& motion, const Eigen::Vector3d& load);
  /// Makes the contact that was added last move by `jacobian` (3 × n) times the motion of a body, in addition to the
  /// contributions of other bodies.
  void add_part(std::size_t body, const Eigen::Ref<const Eigen::Matrix3Xd>& jacobian);

  struct Result {
    /// Largest distance of a contact from its law, ‖λ − Π(λ − u/w)‖ w, in the unit of motion: λ is its load, u its
    /// motion with De Saxcé's shift, w a third of the trace of its response, Π the projection into its cone. Contacts
    /// that no load can move are not counted. Infinite if the problem is not finite; then all loads are zero.
    double residual = 0.0;
    int iterations = 0;  ///< iterations of the first two methods
    int factors = 0;     ///< factorised systems of equations
  };
  /// Solves the problem to a residual of at most `enough` and 1 % of the largest motion without loads. If a few
  /// iterations suffice for it, solves it to `share` of that motion, or to a thousandth of `enough`.
  Result solve(double share, double enough);

  Eigen::Vector3d load(std::size_t contact) const;
  /// Returns the change of a body's motion due to the loads.
  Eigen::VectorXd change(std::size_t body) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace spring_workbench::friction
