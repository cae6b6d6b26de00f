#pragma once

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bullet_types.h"
#include "solver_contact.h"
#include "spring_workbench/bodies/free_motion.h"
#include "spring_workbench/friction/contact_problem.h"
#include "spring_workbench/friction/surfaces.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::rigid_bodies {

/// Solver of Bullet's islands: its contacts, solved as one friction::ContactProblem, in which driven bodies respond by
/// their full 6 × 6 compliance instead of a mass. Before that, contacts of theirs that are closed and approach are
/// stopped by impulses.
class DrivenSolver final : public btSequentialImpulseConstraintSolver {
 public:
  DrivenSolver(friction::Surfaces& surfaces, double gravity) : gravity_(gravity), surfaces_(surfaces) {}
  /// The driven bodies of the next step, which lasts `h` [s].
  void set_driven(std::vector<Driven> driven, double h);

  /// What stopped a contact at the start of the last step, on the manifold's first body [N·s].
  Vector3d impact_on(const btManifoldPoint& point) const;
  /// Largest distance of a contact of the last step from its law [m]; see friction::ContactProblem.
  double residual() const { return residual_; }
  /// Whether a body was driven in it.
  bool drove(const btRigidBody* bullet) const { return find(driven_, bullet) != nullptr; }
  /// See RigidWorld::first_bounce.
  double bounces_at() const { return bounces_at_; }
  /// How free bodies move in it.
  const std::vector<bodies::FreeMotion>& free_motions() const { return motions_; }
  /// Depth of its deepest contact of rigid materials, at its start [m].
  double deepest() const { return deepest_; }

 private:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** constraints, int constraint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* debug) override;

  using Contact = SolverContact;
  Contact make_contact(int index, const btContactSolverInfo& info) const;
  std::vector<Contact> make_contacts(const btContactSolverInfo& info, btPersistentManifold** manifolds, int count);
  /// Lets contacts with a surface obey its law.
  void obey_surfaces(std::vector<Contact>& contacts);
  bool closes_fast(const Contact& contact) const {  ///< above the speed at which it bounces
    return -motion(contact, true)[0] > std::max(scene::rest_speed, contact.gap / h_);
  }
  double missing_along_normal(const Contact& contact) const;
  double restitution(const Contact& contact) const;
  Vector6d velocity(std::size_t solver_body, bool at_start) const;
  Vector3d motion(const Contact& contact, bool at_start) const;
  const Driven* driven_of(std::size_t solver_body) const {
    return find(driven_, m_tmpSolverBodyPool[static_cast<int>(solver_body)].m_originalBody);
  }
  bool drives(const Contact& c) const { return driven_of(c.a) != nullptr || driven_of(c.b) != nullptr; }
  bool pushes(std::size_t i) const {  ///< whether it moves and is not driven
    return driven_of(i) == nullptr && !m_tmpSolverBodyPool[static_cast<int>(i)].internalGetInvMass().isZero();
  }
  /// Response of a body's velocity to an impulse: now, if it is an impact, or spread over the step.
  Eigen::MatrixXd response(std::size_t solver_body, bool impact) const;
  /// Solves the contacts, and lets them bounce, after a change of the bodies' velocities, to which it adds its own.
  void solve(std::vector<Contact>& contacts, bool impact, std::vector<Vector6d>& change);
  /// The same once; `bounces`: those that are to bounce end their approach though they are open yet.
  void solve_once(std::vector<Contact>& contacts, bool impact, bool bounces, std::vector<Vector6d>& change);
  /// Stops what approaches; returns what that does to the bodies' velocities over the step.
  std::vector<Vector6d> stop_approaches(std::vector<Contact>& contacts);
  /// Adds what `load` along the axes of a contact does to those of its bodies that are driven.
  void load_driven(const Contact& contact, const Vector3d& load, Wrench DrivenBody::*to) const;
  void find_motions(const btContactSolverInfo& info, std::vector<Contact>& contacts,
                    const std::vector<Vector6d>& by_impact, const std::vector<Vector6d>& change);
  void hand_back(const std::vector<Contact>& contacts, const std::vector<Vector6d>& change);

  std::vector<Driven> driven_;
  std::unordered_map<const btManifoldPoint*, Vector3d> impacts_;  ///< see impact_on()
  std::vector<bodies::FreeMotion> motions_;
  double h_ = 1.0;
  double enough_ = 0.0;  ///< residual to which contacts are solved [m/s]
  double residual_ = 0.0, deepest_ = 0.0, bounces_at_ = 0.0;
  double gravity_;
  friction::ContactProblem problem_;
  friction::Surfaces& surfaces_;
};

}  // namespace spring_workbench::rigid_bodies
