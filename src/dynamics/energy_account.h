#pragma once

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::dynamics {

/// Energy of body and fork after a step of `h` to `t + h` [s] beyond what hand, gravity, contact and dampers account
/// for [J]: their work by Lobatto's rule of four points on the cubics through both ends.
double energy_added(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    const StrainState& begin, const StrainState& end);

/// Energy of springs and motion in the frame of the handle after a step to `t` [s] less what there was before and what
/// the weight, the handle's acceleration and the contact, as they are at `t`, did on the way [J]: not above 0 for
/// implicit Euler on a fork that is linear.
double energy_gained(const HeldBody& body, const motion::FrameMotion& handle, double t, const StrainState& begin,
                     const StrainState& end);

}  // namespace spring_workbench::dynamics
