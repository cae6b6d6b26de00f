#pragma once

#include <utility>

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

}  // namespace spring_workbench::rigid_bodies
