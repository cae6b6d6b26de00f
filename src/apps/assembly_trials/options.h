#pragma once

#include <optional>
#include <string>

#include "spring_workbench/assembly/simulated_operator.h"
#include "spring_workbench/simulation/settings.h"

namespace spring_workbench::assembly_trials {

/// Options of the command line.
struct Options {
  std::string scene;                        ///< path or package:// URI of a URDF with targets
  simulation::SimulationSettings settings;  ///< for all tools
  std::string tool;                         ///< label of one tool; empty: all
  int trials = 20;                          ///< number of trials per tool
  int seed = 1;                             ///< seed of the first trial; later trials increment it
  assembly::OperatorSettings hand;          ///< how the operator moves, apart from the seed
  double time_limit = 300.0;                ///< limit of a trial [s]
  std::string out;                          ///< path of the CSV file; empty: none
  std::string table;                        ///< path of the table of means, in CSV; empty: none
  std::string record;                       ///< path of the motion file of the first trial; empty: none
};

/// Parses the command line. Returns nothing for `--help`. Throws InputError for invalid arguments.
std::optional<Options> parse_options(int argc, char** argv);

/// Names of the columns of `--out`, the same as in the records of a study with people (doc/reference.md).
std::string csv_header();

/// The text that `--help` prints.
std::string help_text();

}  // namespace spring_workbench::assembly_trials
