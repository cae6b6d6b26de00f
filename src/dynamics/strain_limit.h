#pragma once

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::dynamics {

/// Where a rod cannot have the strain `end` that a step from `begin` to the time `t` [s] led to, and one coordinate is
/// enough to tell why (a rod compressed to nothing, wound up too far): that coordinate stops where its way ends, as
/// against a stop that gives nothing back; the others go on, with the momentum of the body but for the stop's impulse.
/// False, and nothing done, where there is no such coordinate.
bool stop_at_limit(const HeldBody& body, double t, const StrainState& begin, StrainState& end);

}  // namespace spring_workbench::dynamics
