#pragma once

#include <optional>
#include <string>

#include "spring_workbench/assembly/simulated_operator.h"
#include "spring_workbench/simulation/settings.h"

namespace spring_workbench::assembly_trials {

/// What the command line asks for.
struct Options {
  std::string scene;                        ///< path or package:// URI of a URDF with targets
  simulation::SimulationSettings settings;  ///< of all tools
  std::string tool;                         ///< label of one tool; empty: all
  int trials = 20;                          ///< of each tool
  int seed = 1;                             ///< of the first trial; the others count up
  assembly::OperatorSettings hand;          ///< how the operator moves, apart from the seed
  double time_limit = 300.0;                ///< of a trial [s]
  std::string out;                          ///< path of the CSV file; empty: none
  std::string table;                        ///< path of the Markdown table; empty: none
  std::string record;                       ///< path of the motion file of the first trial; empty: none
};

/// Nothing where help is asked for. Throws InputError for everything that cannot be used.
std::optional<Options> parse_options(int argc, char** argv);

/// Names of the columns of `--out`, those of the records of a study with people (doc/reference.md).
std::string csv_header();

/// What `--help` prints.
std::string help_text();

}  // namespace spring_workbench::assembly_trials
