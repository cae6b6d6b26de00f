#pragma once

#include <Eigen/Core>
#include <vector>

#include "spring_workbench/math/spatial.h"

namespace spring_workbench::friction {

/// Contact between two bodies that may bounce; vectors are along [normal, across, across].
struct BouncingContact {
  using Jacobian = Eigen::Matrix<double, 3, 6>;
  std::size_t a = 0, b = 0;  ///< bodies
  Jacobian J_a, J_b;         ///< motion = J_a · V_a + J_b · V_b
  Vector3d motion;           ///< without any impulse of this solve [m/s]
  Vector3d impulse;          ///< [N·s]
  double friction = 0.0;
  double restitution = 0.0;  ///< share of its normal impulse that it gives back

  /// Its motion by changes of the velocities of all bodies.
  Vector3d by(const std::vector<Vector6d>& change) const { return J_a * change[a] + J_b * change[b]; }
};

/// Makes contacts bounce after their impulses have ended the approach and changed the velocities by `change`: each
/// gives back its share of its normal impulse (Poisson's law), with the friction that removes the most energy. Unlike
/// Newton's law, this returns no more energy than was lost. With different shares it could return more; all then give
/// back less. `responses`: of the bodies' velocities to impulses; of size 0 for those that do not move. Out: both sums.
void give_back(const std::vector<Eigen::MatrixXd>& responses, const std::vector<BouncingContact*>& contacts,
               std::vector<Vector6d>& change);

}  // namespace spring_workbench::friction
