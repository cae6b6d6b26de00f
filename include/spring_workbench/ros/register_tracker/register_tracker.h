#pragma once

#include <optional>
#include <string>

namespace spring_workbench::register_tracker {

/// Options of the command line.
struct Options {
  bool pivot = false;  ///< whether to find the tip instead of the tracker
  std::string landmarks, motion, registration, out;
  double largest_residual = 5e-3;  ///< [m]
};

/// Parses the command line. Returns nothing for `--help`. Throws InputError for invalid arguments.
std::optional<Options> parse_options(int argc, char** argv);

/// The text that `--help` prints.
std::string help_text();

/// Finds the tracker or the tip from a motion file or, as a ROS node, from the output of the running driver, and writes
/// the result to a file. Throws InputError, and writes nothing, if options or touches are unusable.
void run(const Options& options, int argc, char** argv);

}  // namespace spring_workbench::register_tracker
