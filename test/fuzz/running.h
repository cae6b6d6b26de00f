#pragma once

#include <functional>
#include <string>

#include "fuzz/targets.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::fuzz {

/// Runs `work`. True when it came to its end; false when it refused its input, in one line.
bool accepted(const std::function<void()>& work);

/// All that a simulation gives out is finite.
void check_finite(const simulation::Simulation& simulation);

/// A hand that goes down into the first movable body's place, grasps it and goes away with it, for a quarter of a
/// second.
void run_a_hand(simulation::Simulation& simulation);

}  // namespace spring_workbench::fuzz
