#include "solver_contact.h"

#include <algorithm>
#include <cmath>

#include "bullet_types.h"
#include "constants.h"

namespace spring_workbench::rigid_bodies {

const Driven* find(const std::vector<Driven>& driven, const btRigidBody* bullet) {
  const auto found = std::find_if(driven.begin(), driven.end(), [&](const Driven& d) { return d.bullet == bullet; });
  return bullet == nullptr || found == driven.end() ? nullptr : &*found;
}

void SolverContact::keep_force(double h) const {
  point->m_appliedImpulse = impulse[0] / h;
  point->m_appliedImpulseLateral1 = impulse[1] / h;
  point->m_appliedImpulseLateral2 = impulse[2] / h;
}

Vector3d SolverContact::force_before() const {
  return {point->m_appliedImpulse, point->m_appliedImpulseLateral1, point->m_appliedImpulseLateral2};
}

SolverContact contact_of(const btSolverConstraint& along, const btConstraintArray& across) {
  SolverContact contact;
  contact.point = static_cast<btManifoldPoint*>(along.m_originalContactPoint);
  contact.a = static_cast<std::size_t>(along.m_solverBodyIdA);
  contact.b = static_cast<std::size_t>(along.m_solverBodyIdB);
  contact.friction = along.m_friction;
  for (int k = 0; k < 3; ++k) {
    const btSolverConstraint& c = k == 0 ? along : across[along.m_frictionIndex + k - 1];
    contact.J_a.row(k) = both(c.m_contactNormal1, c.m_relpos1CrossNormal).transpose();
    contact.J_b.row(k) = both(c.m_contactNormal2, c.m_relpos2CrossNormal).transpose();
    contact.missing[k] = c.m_jacDiagABInv > 0.0 ? c.m_rhs / c.m_jacDiagABInv : 0.0;
  }
  return contact;
}

double time_to_close(double gap, double approach, double gravity) {
  if (!(gap > 0.0 && approach > 0.0)) return 0.0;
  return 2.0 * gap / (approach + std::sqrt(approach * approach + 4.0 * gravity * gap));
}

Matrix6d mobility_of(const btSolverBody& body) {
  Matrix6d mobility = Matrix6d::Zero();
  mobility.diagonal().head<3>() = from_bullet(body.internalGetInvMass());
  const btMatrix3x3& inverse_inertia = body.m_originalBody->getInvInertiaTensorWorld();
  for (int i = 0; i < 3; ++i) mobility.block<1, 3>(3 + i, 3) = from_bullet(inverse_inertia[i]).transpose();
  return mobility;
}

void take_changes(const std::vector<Vector6d>& change, btAlignedObjectArray<btSolverBody>& bodies) {
  for (int i = 0; i < bodies.size(); ++i) {
    const Vector6d& c = change[static_cast<std::size_t>(i)];
    bodies[i].internalGetDeltaLinearVelocity() = to_bullet(Vector3d(c.head<3>()));
    bodies[i].internalGetDeltaAngularVelocity() = to_bullet(Vector3d(c.tail<3>()));
  }
}

void add_free_motions(const btContactSolverInfo& info, const btAlignedObjectArray<btSolverBody>& bodies,
                      const std::vector<friction::BodyVelocities>& velocities, std::vector<SolverContact>& contacts,
                      double h, double resting, std::vector<bodies::FreeMotion>& motions) {
  std::vector<bodies::FreeMotion> all(velocities.size());
  for (const SolverContact& c : contacts) {
    if (!(c.impulse[0] > 0.0)) continue;
    for (const auto& [body, J] : {std::pair(c.a, &c.J_a), std::pair(c.b, &c.J_b)}) {
      all[body].is_pressed = true;
      all[body].load_W += to_wrench(J->transpose() * c.impulse / h);
    }
  }
  const std::vector<bool> mean = friction::move_with_mean_velocity(velocities, bouncing(contacts), h, resting);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!velocities[i].free) continue;
    const btSolverBody& body = bodies[static_cast<int>(i)];
    bodies::FreeMotion& m = motions.emplace_back(all[i]);
    m.body = static_cast<std::size_t>(body.m_originalBody->getUserIndex());
    m.start_W = to_twist(velocities[i].start);
    m.change_W = to_twist(velocities[i].end - velocities[i].start);
    m.load_W.force += from_bullet(body.m_externalForceImpulse) / (h * body.m_originalBody->getInvMass());
    m.push_W = to_twist(h * both(body.m_pushVelocity, info.m_splitImpulseTurnErp * body.m_turnVelocity));
    m.mean = mean[i];
  }
}

WorldContact world_contact(const btManifoldPoint& point, int a, int b, double h) {
  WorldContact c;
  const double sign = a >= 0 ? 1.0 : -1.0;  // the bench is never the first
  c.body = static_cast<std::size_t>(a >= 0 ? a : b);
  c.other = std::min(a, b) < 0 ? RigidWorld::bench : static_cast<std::size_t>(b);
  c.n_W = sign * from_bullet(point.m_normalWorldOnB);
  c.impulse_W = sign * h *
                Vector3d(point.m_appliedImpulse * from_bullet(point.m_normalWorldOnB) +
                         point.m_appliedImpulseLateral1 * from_bullet(point.m_lateralFrictionDir1) +
                         point.m_appliedImpulseLateral2 * from_bullet(point.m_lateralFrictionDir2));
  c.p_W = 0.5 * from_bullet(point.getPositionWorldOnA() + point.getPositionWorldOnB());
  c.depth = std::max(0.0, -point.getDistance() - 2.0 * contact_skin);
  return c;
}

std::pair<int, int> bodies_of(const btManifoldPoint& point, btPersistentManifold** manifolds, int manifold_count) {
  const btPersistentManifold& of = **std::find_if(manifolds, manifolds + manifold_count, [&](const auto* manifold) {
    bool is = false;
    for (int k = 0; k < manifold->getNumContacts(); ++k) is = is || &manifold->getContactPoint(k) == &point;
    return is;
  });
  return {of.getBody0()->getUserIndex(), of.getBody1()->getUserIndex()};
}

}  // namespace spring_workbench::rigid_bodies
