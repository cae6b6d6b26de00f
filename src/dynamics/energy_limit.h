#pragma once

#include "spring_workbench/dynamics/step_control.h"

namespace spring_workbench::dynamics {

/// Keeps the energy of body, fork and weight from growing while the handle rests, no contact pushes and no family
/// returns to zero strain: what a step gains is taken from its speed, or, where that is not enough, its way is cut
/// short as well. Returns whether anything had to be taken. `begin` and `end` are the states at `t` and `t + h`.
bool hold_energy(const HeldBody& body, const motion::FrameMotion& handle, double t, double h, const StrainState& begin,
                 StrainState& end, StepControl::Memory& memory);

}  // namespace spring_workbench::dynamics
