#pragma once

#include <utility>
#include <vector>

#include "bullet_types.h"
#include "spring_workbench/friction/bounce.h"

class btManifoldPoint;
class btPersistentManifold;

namespace spring_workbench::rigid_bodies {

/// Contact between two bodies of a solver; vectors are along [normal, across, across].
struct SolverContact : friction::BouncingContact {
  btManifoldPoint* point = nullptr;
  Vector3d missing;    ///< motion that its law asks for in addition to `motion` [m/s]
  double gap = 0.0;    ///< [m]
  bool stops = false;  ///< its approach ends though it is open yet and nothing is given back
  int surface = -1;    ///< of friction::Surfaces
  Vector3d n_W;        ///< normal, from the body with the lower user index; set if it has a surface

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
