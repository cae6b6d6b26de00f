#include "spring_workbench/ros/register_tracker/register_tracker.h"

#include "spring_workbench/config/command_line.h"

/// Registers the tracker from touches of known landmarks, or the stylus tip from pivoting, into a file for the launch
/// files.
int main(int argc, char** argv) {
  using namespace spring_workbench;
  return config::run_program(
      "register_tracker", register_tracker::help_text(), [&] { return register_tracker::parse_options(argc, argv); },
      [&](const register_tracker::Options& options) { register_tracker::run(options, argc, argv); });
}
