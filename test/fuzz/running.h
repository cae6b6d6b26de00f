#pragma once

#include <functional>
#include <string>

#include "fuzz/targets.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::fuzz {

/// Runs `work`. Returns true if it completed, false if it refused its input in one line.
bool accepted(const std::function<void()>& work);

/// Checks that all outputs of a simulation are finite.
void check_finite(const simulation::Simulation& simulation);

/// Runs a hand for a quarter of a second that moves into the first movable body, grasps it and carries it away.
void run_a_hand(simulation::Simulation& simulation);

}  // namespace spring_workbench::fuzz
