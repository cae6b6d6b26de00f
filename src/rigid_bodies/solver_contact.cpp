#include "solver_contact.h"

#include <algorithm>

#include "bullet_types.h"

namespace spring_workbench::rigid_bodies {

std::pair<int, int> bodies_of(const btManifoldPoint& point, btPersistentManifold** manifolds, int manifold_count) {
  const btPersistentManifold& of = **std::find_if(manifolds, manifolds + manifold_count, [&](const auto* manifold) {
    bool is = false;
    for (int k = 0; k < manifold->getNumContacts(); ++k) is = is || &manifold->getContactPoint(k) == &point;
    return is;
  });
  return {of.getBody0()->getUserIndex(), of.getBody1()->getUserIndex()};
}

}  // namespace spring_workbench::rigid_bodies
