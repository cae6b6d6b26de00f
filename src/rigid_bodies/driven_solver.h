#pragma once

#include <vector>

#include "bullet_types.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::rigid_bodies {

/// Bullet's contact solver with four changes: driven bodies answer to a load by their full 6 × 6 compliance instead of
/// a mass; before it, contacts of theirs that are closed and approach are stopped by impulses; friction lies in a round
/// cone; and the sweeps go on until they change nothing. Where they are too many and leave a miss, all contacts are
/// solved at once.
class DrivenSolver final : public btSequentialImpulseConstraintSolver {
 public:
  struct Driven {
    const btRigidBody* bullet;
    DrivenBody* body;
  };
  /// The driven bodies of the next step, which lasts `h` [s].
  void set_driven(std::vector<Driven> driven, double h);

  /// What stopped a contact at the start of the last step.
  struct Impact {
    const btManifoldPoint* point;
    Vector3d impulse_W;  ///< on the manifold's first body [N·s]
  };
  const std::vector<Impact>& impacts() const { return impacts_; }
  /// How far a contact that presses would still go in or out in the last step, or another one in [m]: what the sweeps
  /// left.
  double residual() const { return missed_way_; }

 private:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** constraints, int constraint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* debug) override;

  struct Row {
    int a, b;                     ///< solver bodies
    Vector6d J_a, J_b;            ///< rate along the row = J_a · V_a + J_b · V_b
    Vector6d answer_a, answer_b;  ///< what a unit impulse does to the bodies' velocities
    double inverse_effective_mass;
    double target;  ///< rate that is still missing before any impulse of this solve
    double impulse = 0.0;
    double friction = 0.0;  ///< of a normal row
    double gap = 0.0;       ///< of a normal row [m]
    double rate(const std::vector<Vector6d>& change) const;
    void apply(double more, std::vector<Vector6d>& change);
  };
  Row make_row(btSolverConstraint& constraint) const;
  Vector6d velocity(int solver_body, bool at_start) const;
  double rate(const Row& row, bool at_start) const;
  bool drives(const Row& row) const { return driven_of(row.a) != nullptr || driven_of(row.b) != nullptr; }
  Vector6d response(int solver_body, const Vector6d& J, const Vector6d& as_free) const;
  const Driven* driven_of(int solver_body) const;
  struct Rows {
    std::vector<Row> normal;       ///< one per contact
    std::vector<Row> across;       ///< two per contact
    std::vector<Vector6d> change;  ///< of the bodies' velocities, by the impulses so far
    Row& operator[](std::size_t k) { return k < normal.size() ? normal[k] : across[k - normal.size()]; }
    void clear();  ///< no impulses
  };
  Rows make_rows(const btContactSolverInfo& info);
  Row impact_row(const Row& row) const;
  /// Stops what approaches, and takes what that does to the rest of the step into `rows`.
  void stop_approaches(Rows& rows);
  /// Adds `amount` of what the row does to those of its bodies that are driven.
  void load_driven(const Row& row, double amount, Wrench DrivenBody::*load) const;
  void hand_back_impacts(const Rows& rows, const std::vector<std::size_t>& contacts);
  /// The largest changes in a sweep: of an impulse [N·s], and of the way that its row alone would make of that [m].
  struct Change {
    double impulse = 0.0, path = 0.0;
  };
  /// One projected Gauss–Seidel sweep.
  Change iteration(Rows& rows) const;
  bool iterate_until_done(Rows& rows) const;  ///< false: the sweeps were too many
  void solve_at_once(Rows& rows) const;       ///< by solve_in_cones(), where that is nearer to the law
  double missed(const Rows& rows) const;      ///< see residual()
  void solve(Rows& rows);
  void hand_back(const Rows& rows);

  std::vector<Driven> driven_;
  std::vector<Impact> impacts_;
  double h_ = 1.0;
  double missed_way_ = 0.0;
};

}  // namespace spring_workbench::rigid_bodies
