#pragma once

#include <Eigen/Core>
#include <vector>

#include "spring_workbench/math/spatial.h"

namespace spring_workbench::friction {

/// Contact between two bodies that may bounce; vectors are along [normal, tangent, tangent].
struct BouncingContact {
  using Jacobian = Eigen::Matrix<double, 3, 6>;
  std::size_t a = 0, b = 0;  ///< indices of the bodies
  Jacobian J_a, J_b;         ///< velocity of the contact = J_a · V_a + J_b · V_b
  Vector3d motion;           ///< velocity without the impulses of this solution [m/s]
  Vector3d impulse;          ///< [N·s]
  double friction = 0.0;
  double restitution = 0.0;      ///< fraction of the normal impulse that is returned
  double gap = 0.0;              ///< at the start of the step [m]
  bool by_end_velocity = false;  ///< see move_with_mean_velocity()

  /// Change of the contact's velocity due to changes of the velocities of all bodies.
  Vector3d by(const std::vector<Vector6d>& change) const { return J_a * change[a] + J_b * change[b]; }
};

/// Applies restitution after impulses have ended the approach of the contacts and changed the velocities by `change`:
/// each contact returns a fraction of its normal impulse (Poisson's law), with the friction that removes the most
/// energy. Unlike Newton's law, this returns no more energy than was lost. If the fractions differ, it might; all
/// fractions are then reduced. `responses`: of the bodies' velocities to impulses, of size 0 for bodies that do not
/// move. Adds the new impulses to those of the contacts, and their effect to `change`.
void apply_restitution(const std::vector<Eigen::MatrixXd>& responses, const std::vector<BouncingContact*>& contacts,
                       std::vector<Vector6d>& change);

}  // namespace spring_workbench::friction
