#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/hand_input/settings.h"
#include "spring_workbench/simulation/settings.h"

namespace spring_workbench::replay {

/// Options of the command line.
struct Options {
  std::string scene;                 ///< path or package:// URI of a URDF
  std::vector<std::string> motions;  ///< paths, one per stylus; empty if `bag` is given
  std::string bag;                   ///< path; empty if `motions` are given
  std::string parent, child;         ///< frames of the stylus' transform in the bag
  bool hand_only = false;            ///< plays only the hands of the bag, even if it has a journal
  std::string out;                   ///< path of the CSV file of the objects
  double rate = 50.0;                ///< output times per second [Hz]
  simulation::SimulationSettings settings;
  hand_input::InputSettings input;
  std::vector<std::pair<std::string, std::string>> given;  ///< place and name of all that the user gave of the above
};

/// Reads the command line and the settings file that it names. Returns nothing for `--help`. Throws InputError for
/// invalid arguments or settings.
std::optional<Options> parse_options(int argc, char** argv);

/// RUN.csv → RUN.fork.csv
std::string fork_path(const std::string& path);

/// Throws InputError if something was given that a journal determines, so that it would have no effect.
void check_beside_journal(const Options& options);

/// The text that `--help` prints.
std::string help_text();

}  // namespace spring_workbench::replay
