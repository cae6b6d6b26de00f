#pragma once

#include <vector>

#include "bullet_types.h"
#include "spring_workbench/world/rigid_world.h"

namespace spring_workbench {

/// Bullet's contact solver with three changes: driven bodies answer to a load by their full 6 × 6 compliance instead of a
/// mass; friction lies in a round cone; and the sweeps go on until they change nothing.
class DrivenSolver final : public btSequentialImpulseConstraintSolver {
 public:
  struct Driven {
    const btRigidBody* bullet;
    DrivenBody* body;
  };
  /// The driven bodies of the next step, which lasts `h` [s].
  void set_driven(std::vector<Driven> driven, double h);

 private:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                                             int manifold_count, btTypedConstraint** constraints, int constraint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* debug) override;

  using Vector6d = Eigen::Matrix<double, 6, 1>;
  struct Row {
    int a, b;                  ///< solver bodies
    Vector6d J_a, J_b;         ///< rate along the row = J_a · V_a + J_b · V_b
    Vector6d answer_a, answer_b;  ///< what a unit impulse does to the bodies' velocities
    double inverse_effective_mass;
    double target;             ///< rate that is still missing before any impulse of this solve
    double impulse = 0.0;
    double rate(const std::vector<Vector6d>& change) const;
    void apply(double more, std::vector<Vector6d>& change);
  };
  Row make_row(btSolverConstraint& constraint) const;
  Vector6d answer(int solver_body, const Vector6d& J, const Vector6d& as_free) const;
  const Driven* driven_of(int solver_body) const;
  struct Rows {
    std::vector<Row> normal;          ///< one per contact
    std::vector<Row> across;          ///< two per contact
    std::vector<Vector6d> change;     ///< of the bodies' velocities, by the impulses so far
  };
  Rows make_rows(const btContactSolverInfo& info);
  /// One projected Gauss–Seidel sweep; returns the largest change of an impulse.
  double sweep(Rows& rows) const;
  void solve(Rows& rows) const;
  void hand_back(const Rows& rows);

  std::vector<Driven> driven_;
  double h_ = 1.0;
};

}  // namespace spring_workbench
