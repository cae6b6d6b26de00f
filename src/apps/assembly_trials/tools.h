#pragma once

#include <string>
#include <vector>

#include "spring_workbench/simulation/settings.h"

namespace spring_workbench::assembly_trials {

/// The labels of the compared tools, in the order of the table.
std::vector<std::string> tool_labels();

/// The settings `base` with the tool called `label`.
simulation::SimulationSettings with_tool(const std::string& label, simulation::SimulationSettings base);

}  // namespace spring_workbench::assembly_trials
