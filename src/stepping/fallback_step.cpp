#include "fallback_step.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "constants.h"
#include "energy_account.h"
#include "spring_workbench/dynamics/linearised_motion.h"

namespace spring_workbench::stepping {

void fallback_step(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                   dynamics::StrainState& state) {
  const dynamics::HandleState end = body.state_at(handle, t + h);
  const dynamics::StrainState begin = state;
  const dynamics::LinearisedMotion motion(body, end, begin.q);
  const math::ImplicitMatrix matrix = motion.implicit(h);
  const auto by = [&](const rod::StrainVector& acceleration) -> dynamics::StrainState {
    const rod::StrainVector q_dot =
        begin.q_dot + matrix.solve(h * (motion.M * acceleration) - h * h * (motion.K * begin.q_dot));
    return {begin.q + h * q_dot, q_dot};
  };
  const EnergyGain gained(body, end, begin);
  // Takes from the rates what has been gained. Returns false if even at rest there is more energy than before.
  const auto within_energy = [&](const dynamics::StrainState& found) {
    const double left = -gained({found.q, 0.0 * found.q_dot});
    const double moving = 0.5 * found.q_dot.dot(body.mass_matrix(t + h, found.q) * found.q_dot);
    state = found;
    if (moving > left) state.q_dot *= std::sqrt(std::max(0.0, left) / moving);
    return left > 0.0;
  };
  if (within_energy(by(body.acceleration(end, begin.q, begin.q_dot)))) return;
  // With a constant force and mass the rule loses energy; with the force of the motion itself it may not.
  const rod::StrainVector dampers = motion.M.llt().solve(motion.D * begin.q_dot);
  const dynamics::StrainState whole = by(body.acceleration(end, begin.q, 0.0 * begin.q_dot) - dampers);
  // Where force and mass change too much on the way: as far as the energy reaches.
  double part = 1.0;
  for (int i = 0; i < most_path_halvings; ++i, part *= 0.5) {
    if (within_energy({begin.q + part * (whole.q - begin.q), part * whole.q_dot})) return;
  }
  state = {begin.q, 0.0 * begin.q_dot};
}

}  // namespace spring_workbench::stepping
