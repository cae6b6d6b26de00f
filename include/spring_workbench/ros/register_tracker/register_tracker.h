#pragma once

#include <optional>
#include <string>

namespace spring_workbench::register_tracker {

/// What the command line asks for.
struct Options {
  bool pivot = false;  ///< finds the tip, else the tracker
  std::string landmarks, motion, registration, out;
  double largest_residual = 5e-3;  ///< [m]
};

/// Nothing where help is asked for. Throws InputError for everything that cannot be used.
std::optional<Options> parse_options(int argc, char** argv);

/// What `--help` prints.
std::string help_text();

/// Finds the tracker or the tip from a motion file, or, as a ROS node, from what the running driver sends; writes the
/// file. Throws InputError for what is given or touched and cannot be used; nothing is written then.
void run(const Options& options, int argc, char** argv);

}  // namespace spring_workbench::register_tracker
