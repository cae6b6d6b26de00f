#include "driven_solver.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "constants.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::rigid_bodies {
void DrivenSolver::set_driven(std::vector<Driven> driven, double h) {
  driven_ = std::move(driven);
  surfaces_.begin_step(h);
  impacts_.clear();
  motions_.clear();
  residual_ = deepest_ = 0.0;
  bounces_at_ = std::numeric_limits<double>::infinity();
  h_ = h;
}

Eigen::MatrixXd DrivenSolver::response(std::size_t solver_body, bool impact) const {
  // An impulse p spread over the step is a wrench p / h, which moves the body on by compliance · p / h in h.
  if (const Driven* driven = driven_of(solver_body)) {
    return impact ? driven->body->mobility : Matrix6d(driven->body->compliance / (h_ * h_));
  }
  if (!pushes(solver_body)) return Eigen::MatrixXd(0, 0);
  return mobility_of(m_tmpSolverBodyPool[static_cast<int>(solver_body)]);
}

Vector6d DrivenSolver::velocity(std::size_t solver_body, bool at_start) const {
  const btSolverBody& body = m_tmpSolverBodyPool[static_cast<int>(solver_body)];
  if (at_start) {
    if (const Driven* driven = driven_of(solver_body)) return to_vector(driven->body->V_WO_W);
    return both(body.m_linearVelocity, body.m_angularVelocity);
  }
  return both(body.m_linearVelocity + body.m_externalForceImpulse,
              body.m_angularVelocity + body.m_externalTorqueImpulse);
}

Vector3d DrivenSolver::motion(const Contact& contact, bool at_start) const {
  return contact.J_a * velocity(contact.a, at_start) + contact.J_b * velocity(contact.b, at_start);
}

DrivenSolver::Contact DrivenSolver::make_contact(int index, const btContactSolverInfo& info) const {
  const btSolverConstraint& along = m_tmpSolverContactConstraintPool[index];
  Contact contact = contact_of(along, m_tmpSolverContactFrictionConstraintPool);
  contact.impulse = h_ * contact.force_before();  // where the search starts
  contact.friction = along.m_friction;
  contact.gap = contact.point->getDistance() + info.m_linearSlop;
  contact.motion = motion(contact, false);
  // Bullet's own is by Newton's law of restitution.
  if (drives(contact) || contact.point->m_combinedRestitution > 0.0) contact.missing[0] = missing_along_normal(contact);
  contact.restitution = restitution(contact);
  contact.closes_at = time_to_close(contact.gap, -motion(contact, true)[0], gravity_);
  return contact;
}

std::vector<DrivenSolver::Contact> DrivenSolver::make_contacts(const btContactSolverInfo& info,
                                                               btPersistentManifold** manifolds, int manifold_count) {
  surfaces_.clear();
  std::vector<Contact> contacts;
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    Contact& c = contacts.emplace_back(make_contact(i, info));
    if (!surfaces_.none()) {
      const auto [a, b] = bodies_of(*c.point, manifolds, manifold_count);
      c.n_W = (a < b ? 1.0 : -1.0) * from_bullet(c.point->m_normalWorldOnB);
      c.surface = surfaces_.between(a, b, c.n_W, c.restitution > 0.0 || closes_fast(c));
      if (surfaces_.complies(c.surface)) c.restitution = 0.0;
    }
    // An indentation is no penetration, neither deep nor for Bullet to undo; those of driven bodies are by loads.
    if (c.surface >= 0 || drives(c)) m_tmpSolverContactConstraintPool[i].m_rhsPenetration = 0.0;
    if (c.surface < 0) deepest_ = std::max(deepest_, -c.gap);
  }
  return contacts;
}

void DrivenSolver::obey_surfaces(std::vector<Contact>& contacts) {
  for (Contact& c : contacts) {
    if (surfaces_.complies(c.surface)) c.comply(h_);
    const bool bounces_later = c.point->m_combinedRestitution > 0.0 && c.closes_at > at_once;
    if (surfaces_.collides(c.surface)) c.stops = !drives(c) && !bounces_later && closes_fast(c);
  }
}

double DrivenSolver::missing_along_normal(const Contact& contact) const {
  const double left = contact.gap / h_;
  if (!drives(contact)) return -contact.motion[0] - std::max(0.0, left);  // a penetration is undone by Bullet
  // A driven body's velocity is its path over the step. A penetration is undone slowly, or it would become a speed.
  const double share = pushes(contact.a) || pushes(contact.b) ? driven_penetration_share : 1.0;
  return -contact.motion[0] - (contact.gap < 0.0 ? share * std::min(1.0, h_ / recovery_time) : 1.0) * left;
}

double DrivenSolver::restitution(const Contact& contact) const {
  // Driven bodies bounce where they are stopped. What is deeper than a path leads, between triangles that push to both
  // sides, does not: bounces off both have no end.
  if (drives(contact) || contact.gap < -unswept_of_free) return 0.0;
  return -motion(contact, true)[0] > scene::rest_speed ? contact.point->m_combinedRestitution : 0.0;
}

void DrivenSolver::solve_once(std::vector<Contact>& contacts, bool impact, bool bounces,
                              std::vector<Vector6d>& change) {
  problem_.clear();
  const auto bodies = static_cast<std::size_t>(m_tmpSolverBodyPool.size());
  for (std::size_t i = 0; i < bodies; ++i) problem_.add_body(response(i, impact));
  surfaces_.add_to(problem_, bounces);
  for (const Contact& c : contacts) {
    Vector3d rest = c.by(change) - c.missing;
    if (bounces && c.collides()) rest[0] = c.by(change)[0] + c.motion[0];
    if (!bounces && c.surface >= 0) rest[0] += surfaces_.motion(c.surface, c.n_W);
    problem_.add_contact(c.friction, rest, bounces ? c.impulse : Vector3d::Zero());
    for (const auto& [body, J] : {std::pair(c.a, &c.J_a), std::pair(c.b, &c.J_b)}) {
      if (pushes(body) || driven_of(body) != nullptr) problem_.add_part(body, *J);
    }
    surfaces_.add_part(problem_, c.surface, c.n_W);
  }
  residual_ = std::max(residual_, h_ * problem_.solve(solved_share, enough_).residual);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    contacts[i].impulse = (bounces ? Vector3d::Zero() : contacts[i].impulse) + problem_.load(i);
    surfaces_.add_load(contacts[i].surface, contacts[i].n_W, problem_.load(i)[0]);
  }
  for (std::size_t i = 0; i < bodies; ++i) {
    if (pushes(i) || driven_of(i) != nullptr) change[i] += problem_.change(i);
  }
}

void DrivenSolver::solve(std::vector<Contact>& contacts, bool impact, std::vector<Vector6d>& change) {
  const std::vector<Vector6d> before = change;
  solve_once(contacts, impact, true, change);
  if (std::none_of(contacts.begin(), contacts.end(), [](const Contact& c) { return c.collides(); })) return;
  std::vector<Eigen::MatrixXd> responses;
  for (std::size_t i = 0; i < change.size(); ++i) responses.push_back(response(i, impact));
  for (Contact& c : contacts) c.motion += c.by(before);
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= before[i];
  apply_restitution(responses, bouncing(contacts), change);
  for (std::size_t i = 0; i < change.size(); ++i) change[i] += before[i];
  solve_once(contacts, impact, false, change);
}

std::vector<Vector6d> DrivenSolver::stop_approaches(std::vector<Contact>& contacts) {
  std::vector<Contact> closed_ones;
  bool approach = false;
  for (Contact& contact : contacts) {
    const bool bounces_now = contact.restitution > 0.0 && contact.closes_at <= at_once;
    if (contact.restitution > 0.0 && !bounces_now) {
      bounces_at_ = std::min(bounces_at_, contact.closes_at);
      contact.friction = contact.restitution = 0.0;  // it is as good as open if the step ends there
      continue;
    }
    contact.restitution = 0.0;
    if (contact.gap > closed && !bounces_now) continue;
    Contact c = contact;
    c.motion = motion(contact, true);
    c.missing = -c.motion;
    c.impulse.setZero();
    approach = approach || bounces_now || (drives(c) && c.missing[0] * h_ > 0.1 * solved_to);
    const bool bounces =
        bounces_now || (drives(c) && c.missing[0] > scene::rest_speed && !surfaces_.complies(c.surface));
    c.restitution = bounces ? c.point->m_combinedRestitution : 0.0;
    closed_ones.push_back(c);
  }
  std::vector<Vector6d> change(static_cast<std::size_t>(m_tmpSolverBodyPool.size()), Vector6d::Zero());
  if (!approach) return change;
  solve(closed_ones, true, change);
  for (const Contact& c : closed_ones) {
    const Matrix3d axes = c.J_a.isZero(0.0) ? Matrix3d(-c.J_b.leftCols<3>()) : Matrix3d(c.J_a.leftCols<3>());
    impacts_[c.point] = axes.transpose() * c.impulse;
    load_driven(c, c.impulse, &DrivenBody::impact_W);
    if (drives(c) || c.restitution > 0.0) surfaces_.stop(c.surface);
  }
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (const Driven* driven = driven_of(i))
      change[i] = driven->body->displacement_by_impulse * to_vector(driven->body->impact_W) / h_;
  }
  return change;
}

Vector3d DrivenSolver::impact_on(const btManifoldPoint& point) const {
  return impacts_.count(&point) != 0 ? impacts_.at(&point) : Vector3d(Vector3d::Zero());
}

void DrivenSolver::load_driven(const Contact& contact, const Vector3d& load, Wrench DrivenBody::*to) const {
  for (const auto& [body, J] : {std::pair(contact.a, &contact.J_a), std::pair(contact.b, &contact.J_b)}) {
    if (const Driven* driven = driven_of(body)) driven->body->*to += to_wrench(J->transpose() * load);
  }
}

void DrivenSolver::hand_back(const std::vector<Contact>& contacts, const std::vector<Vector6d>& change) {
  take_changes(change, m_tmpSolverBodyPool);
  for (const Contact& contact : contacts) {
    contact.keep_force(h_);
    load_driven(contact, contact.impulse / h_, &DrivenBody::contact_W);
    if (contact.impulse[0] > 0.0 && (surfaces_.complies(contact.surface) || !drives(contact)))
      surfaces_.note_pressed(contact.surface, contact.n_W);
  }
}

void DrivenSolver::find_motions(const btContactSolverInfo& info, std::vector<Contact>& contacts,
                                const std::vector<Vector6d>& by_impact, const std::vector<Vector6d>& change) {
  std::vector<friction::BodyVelocities> velocities(change.size());
  for (std::size_t i = 0; i < change.size(); ++i)
    velocities[i] = {velocity(i, true) + by_impact[i], velocity(i, false) + change[i], pushes(i)};
  for (Contact& c : contacts) c.by_end_velocity = c.surface >= 0 || drives(c);
  add_free_motions(info, m_tmpSolverBodyPool, velocities, contacts, h_, enough_, motions_);
}

btScalar DrivenSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                         btPersistentManifold** manifolds, int manifold_count,
                                                         btTypedConstraint** constraints, int constraint_count,
                                                         const btContactSolverInfo& info, btIDebugDraw* debug) {
  std::vector<Contact> contacts = make_contacts(info, manifolds, manifold_count);
  solveGroupCacheFriendlySplitImpulseIterations(bodies, body_count, manifolds, manifold_count, constraints,
                                                constraint_count, info, debug);
  follow_corrections(info, m_tmpSolverBodyPool, contacts, [&](const Contact& c) { return drives(c); });
  double speed = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(m_tmpSolverBodyPool.size()); ++i)
    speed = std::max(speed, velocity(i, true).head<3>().norm());
  enough_ = std::clamp(residual_share * speed, rest_residual / h_, solved_to / h_);
  const std::vector<Vector6d> by_impact = stop_approaches(contacts);
  std::vector<Vector6d> change = by_impact;
  obey_surfaces(contacts);
  solve(contacts, false, change);
  find_motions(info, contacts, by_impact, change);
  hand_back(contacts, change);
  return 0.0;
}

}  // namespace spring_workbench::rigid_bodies
