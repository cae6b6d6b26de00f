#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/simulated_fastrak/line_faults.h"

namespace spring_workbench::fastrak_simulator {

/// Options of the command line.
struct Options {
  std::vector<std::string> motions;  ///< paths; one for each station
  std::string link;                  ///< path of a link to the pseudo-terminal; empty: none
  double rate = 120.0;               ///< records per second, of all stations together [Hz]
  double speed = 1.0;                ///< rate of the device's clock relative to the wall clock
  double duration = 0.0;             ///< duration by the device's clock [s]; 0: until interrupted
  std::vector<int> switches{1};      ///< stations whose switch works
  std::vector<simulated_fastrak::Fault> faults;
  int seed = 1;
};

/// Parses the command line. Returns nothing for `--help`. Throws InputError for invalid arguments. Arguments that
/// contain := (added by roslaunch) are ignored.
std::optional<Options> parse_options(int argc, char** argv);

/// The text that `--help` prints.
std::string help_text();

}  // namespace spring_workbench::fastrak_simulator
