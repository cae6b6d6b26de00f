#pragma once

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::stepping {

/// Fallback rule that carries `state` from `t` to `t + h` [s] if an integrator finds no solution of its equation: the
/// linearly implicit Euler rule, with implicit springs and dampers and a frozen mass matrix. It is L-stable and always
/// has a solution. It has its own energy balance, in the frame of the handle: elastic and kinetic energy do not grow by
/// more than the work of the weight, the handle's acceleration and the contact over the step.
void fallback_step(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                   dynamics::StrainState& state);

}  // namespace spring_workbench::stepping
