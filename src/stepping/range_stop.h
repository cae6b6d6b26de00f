#pragma once

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::stepping {

/// The stop at the end of the rod's range (compressed to nothing, wound up), for a step of `h` [s] to the moment of
/// `handle` from the strain `begin` inside the range to `end` outside: a one-sided constraint. The strain goes back to
/// the range as the stop's force over the step moves it, against springs and dampers; an impulse takes the rate that
/// leads out, as a stop that gives nothing back (Moreau's time stepping), or those that lead out at two stops. If the
/// strain gains energy on its way back, the rates lose as much.
void stop_at_range(const dynamics::HeldBody& body, const dynamics::HandleForcing& handle, double h,
                   const dynamics::StrainState& begin, dynamics::StrainState& end);

/// How much of the rod's range is used, by strain, at a strain `q`.
rod::StrainVector range_slope(const dynamics::HeldBody& body, double t, const rod::StrainVector& q);

/// Takes from the rates at the end of a step of `h` to `t + h` [s], which a stop or the fallback made, what the body
/// has gained beyond what hand, weight and dampers account for, as far as the rates go. Returns energy_added() of the
/// result [J]. While contact or other tools pull, whose work over a step is not known so well, nothing is taken.
double slow_down(const dynamics::HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                 const dynamics::StrainState& begin, dynamics::StrainState& end);

}  // namespace spring_workbench::stepping
