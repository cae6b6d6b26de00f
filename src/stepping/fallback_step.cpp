#include "fallback_step.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "energy_account.h"
#include "spring_workbench/dynamics/linearised_motion.h"

namespace spring_workbench::stepping {
void fallback_step(const dynamics::HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                   dynamics::StrainState& state) {
  const dynamics::HandleForcing end = body.forcing(handle, t + h);
  const dynamics::StrainState begin = state;
  const dynamics::LinearisedMotion motion(body, end, begin.q);
  const dynamics::ImplicitMatrix matrix(motion, h);
  const auto step = [&](const rod::StrainVector& acceleration) {
    state.q_dot = begin.q_dot + matrix.solve(h * (motion.M * acceleration) - h * h * (motion.K * begin.q_dot));
    state.q = begin.q + h * state.q_dot;
    const double found = 0.5 * state.q_dot.dot(body.mass_matrix(t + h, state.q) * state.q_dot);
    const double allowed = found - energy_gained(body, end, begin, state);
    if (found > allowed) state.q_dot *= std::sqrt(std::max(0.0, allowed) / found);
    return allowed > 0.0;
  };
  if (step(body.acceleration(end, begin.q, begin.q_dot))) return;
  // With a constant force and mass the rule loses energy; with the force of the motion itself it may not.
  const rod::StrainVector dampers = motion.M.llt().solve(motion.D * begin.q_dot);
  step(body.acceleration(end, begin.q, 0.0 * begin.q_dot) - dampers);
}

}  // namespace spring_workbench::stepping
