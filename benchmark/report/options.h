#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// Options of `report`.
struct ReportOptions {
  bool quick = false;          ///< few scenes and settings, no stability counts; when merging, as in the parts
  std::string out = "report";  ///< output folder, created if it does not exist
  std::optional<Shard> shard;  ///< the only shard to measure; its results go to standard output
  std::string queue;  ///< folder shared by all shards, which then take units from a queue; empty: every N-th unit
  std::vector<std::string> parts;    ///< files of all shards, to be merged; empty: none
  std::string commit = "not given";  ///< of the source that the program was built from, for the tables' headers
  /// A recording of the user to report on instead of everything else, with the options of `replay`.
  std::string scene, bag, settings;
  std::vector<std::string> motions;

  bool of_recording() const { return !scene.empty(); }
};

/// Returns nothing for `--help`. Throws InputError for anything but `[--quick] [--out DIR]`,
/// `[--quick] --shard I/N [--queue DIR]`, `[--out DIR] --merge PART...` or
/// `[--quick] [--out DIR] --scene SCENE (--bag FILE | --motion FILE...) [--settings FILE]`; each but `--merge` may have
/// `--commit NAME`.
std::optional<ReportOptions> parse_report_options(int argc, char** argv);

/// The text that `--help` prints.
std::string report_help();

/// Creates the folder if it does not exist. Throws InputError if it cannot be created or written to.
void make_folder(const std::string& folder);

}  // namespace spring_workbench::benchmark
