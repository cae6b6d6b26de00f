#pragma once

#include <string>

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::replay {

// The rows of RUN.csv and RUN.fork.csv, as described by `help_text()`. Numbers have 17 significant digits and a decimal
// point, independent of the locale; of the two quaternions of a rotation, the one with qw ≥ 0 is written.

std::string object_header();
std::string object_rows(double t, const simulation::Simulation& simulation);  ///< one row per movable object
std::string fork_header();
std::string fork_row(double t, const tools::ToolState& fork, std::size_t hand);

}  // namespace spring_workbench::replay
