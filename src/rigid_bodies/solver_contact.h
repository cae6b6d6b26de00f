#pragma once

#include <utility>
#include <vector>

#include "bullet_types.h"
#include "spring_workbench/bodies/free_motion.h"
#include "spring_workbench/friction/bounce.h"
#include "spring_workbench/friction/mean_velocity.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

class btManifoldPoint;
class btPersistentManifold;

namespace spring_workbench::rigid_bodies {

struct Driven {
  const btRigidBody* bullet;
  DrivenBody* body;
};
/// Returns the one that Bullet has as `bullet`, null if it is not among them.
const Driven* find(const std::vector<Driven>& driven, const btRigidBody* bullet);

/// Contact between two bodies of a solver; vectors are along [normal, across, across].
struct SolverContact : friction::BouncingContact {
  btManifoldPoint* point = nullptr;
  Vector3d missing;        ///< motion that its law asks for in addition to `motion` [m/s]
  double closes_at = 0.0;  ///< when it bounces [s]
  bool stops = false;      ///< its approach ends though it is open yet and nothing is given back
  int surface = -1;        ///< of friction::Surfaces
  Vector3d n_W;            ///< normal, from the body with the lower user index; set if it has a surface

  /// Lets Bullet remember the force over a step of `h` [s]; and that of the last step [N].
  void keep_force(double h) const;
  Vector3d force_before() const;
  bool collides() const { return stops || restitution > 0.0; }
  /// Asks for the law of a surface that complies, over a step of `h` [s].
  void comply(double h) {
    missing[0] = -motion[0] - gap / h;
    restitution = 0.0;
  }
};

inline std::vector<friction::BouncingContact*> bouncing(std::vector<SolverContact>& contacts) {
  std::vector<friction::BouncingContact*> all;
  for (SolverContact& c : contacts) all.push_back(&c);
  return all;
}

/// Bullet's contact, from its constraint along the normal and those across.
SolverContact contact_of(const btSolverConstraint& along, const btConstraintArray& across);

/// When two bodies touch that have a gap [m] and an approach [m/s] and that may both fall; conservatively [s].
double time_to_close(double gap, double approach, double gravity);

/// Response of a free body's velocity to an impulse.
Matrix6d mobility_of(const btSolverBody& body);

/// Changes the velocities of Bullet's bodies.
void take_changes(const std::vector<Vector6d>& change, btAlignedObjectArray<btSolverBody>& bodies);

/// Adds how the free ones of Bullet's bodies move over a step of `h` [s]. `resting`: slip that counts as none [m/s].
void add_free_motions(const btContactSolverInfo& info, const btAlignedObjectArray<btSolverBody>& bodies,
                      const std::vector<friction::BodyVelocities>& velocities, std::vector<SolverContact>& contacts,
                      double h, double resting, std::vector<bodies::FreeMotion>& motions);

/// Contact of the world after a step of `h` [s], of bodies with these user indices, without the impulses at its start.
WorldContact world_contact(const btManifoldPoint& point, int a, int b, double h);

/// Returns the user indices of the two bodies of a contact, which is in one of the manifolds.
std::pair<int, int> bodies_of(const btManifoldPoint& point, btPersistentManifold** manifolds, int manifold_count);

/// Lets contacts of driven bodies move with what Bullet moves out of other bodies in this step.
template <typename Drives>
void follow_corrections(const btContactSolverInfo& info, const btAlignedObjectArray<btSolverBody>& bodies,
                        std::vector<SolverContact>& contacts, const Drives& drives) {
  for (SolverContact& c : contacts) {
    if (!drives(c)) continue;
    for (const auto& [body, J] : {std::pair(c.a, &c.J_a), std::pair(c.b, &c.J_b)}) {
      const btSolverBody& moved = bodies[static_cast<int>(body)];
      c.missing[0] -= J->row(0).dot(both(moved.m_pushVelocity, info.m_splitImpulseTurnErp * moved.m_turnVelocity));
    }
  }
}

}  // namespace spring_workbench::rigid_bodies
