#pragma once

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::stepping {

/// The stop at the end of the rod's range (fully compressed, or wound up), a one-sided constraint, for a step of `h`
/// [s] that ends at the time of `handle` and leads from the strain `begin` inside the range to `end` outside it. The
/// force of the stop over the step moves the strain back into the range, against springs and dampers. An impulse
/// without restitution (Moreau's time stepping) removes the rate that leads out of the range, or the rates at two
/// stops. The state has no more energy than at the begin of the step, beyond the work of weight, handle and contact:
/// the rates lose what the strain has gained and, if a strain has too much energy even at rest, it is as far on the
/// straight way from `begin` to `end` as range and energy allow.
void stop_at_range(const dynamics::HeldBody& body, const dynamics::HandleState& handle, double h,
                   const dynamics::StrainState& begin, dynamics::StrainState& end);

/// Derivative of the used fraction of the rod's range by the strain, at the strain `q`.
rod::StrainVector range_slope(const dynamics::HeldBody& body, double t, const rod::StrainVector& q);

/// After a step of `h` to `t + h` [s] that a stop or the fallback rule took, reduces the rates such that the body loses
/// the energy that it has gained beyond the work of hand, weight and dampers, as far as its kinetic energy allows.
/// Returns energy_added() of the result [J]. Nothing is removed while contact or other tools pull, whose work over a
/// step is less well known.
double slow_down(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                 const dynamics::StrainState& begin, dynamics::StrainState& end);

}  // namespace spring_workbench::stepping
