#pragma once

#include <string>
#include <vector>

#include "spring_workbench/simulation/settings.h"

namespace spring_workbench::assembly_trials {

/// The labels of the tools that are compared, in the order of the table.
std::vector<std::string> tool_labels();

/// `base` with the tool called `label` in the hand.
simulation::SimulationSettings with_tool(const std::string& label, simulation::SimulationSettings base);

}  // namespace spring_workbench::assembly_trials
