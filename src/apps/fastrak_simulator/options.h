#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/simulated_fastrak/line_faults.h"

namespace spring_workbench::fastrak_simulator {

/// What the command line asks for.
struct Options {
  std::vector<std::string> motions;  ///< paths; one for each station
  std::string link;                  ///< path of a link to the pseudo-terminal; empty: none
  double rate = 120.0;               ///< records per second, of all stations together [Hz]
  double speed = 1.0;                ///< of the device's clock against the wall's
  double duration = 0.0;             ///< of the device's clock [s]; 0: until it is interrupted
  std::vector<int> switches{1};      ///< stations whose switch works
  std::vector<simulated_fastrak::Fault> faults;
  int seed = 1;
};

/// Nothing where help is asked for. Throws InputError for everything that cannot be used. Words with := in them
/// (roslaunch gives some) are not looked at.
std::optional<Options> parse_options(int argc, char** argv);

/// What `--help` prints.
std::string help_text();

}  // namespace spring_workbench::fastrak_simulator
