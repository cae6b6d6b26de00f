#pragma once

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::stepping {

/// What carries `state` from `t` to `t + h` [s] where an integrator finds no solution of its equation: the linearly
/// implicit Euler rule with the springs and dampers implicit and the mass matrix frozen. It is L-stable and always has
/// a solution. It has an energy balance of its own, in the frame of the handle: springs and motion have no more energy
/// afterwards than before and what the weight, the handle's acceleration and the contact do on the way.
void fallback_step(const dynamics::HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                   dynamics::StrainState& state);

}  // namespace spring_workbench::stepping
