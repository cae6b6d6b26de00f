#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// What `report` was asked for.
struct ReportOptions {
  bool quick = false;              ///< few scenes and settings, no stability counts; when merging as the parts say
  std::string out = "report";      ///< folder to write to; made where it is not there
  std::optional<Shard> shard;      ///< it alone is measured, and what comes out goes to the standard output
  std::string queue;               ///< folder, of all shards: they take units as they come; empty: every N-th one
  std::vector<std::string> parts;  ///< files of all shards, to be merged; empty: none
  /// A recording of the user's own, to be reported on in place of the rest: as `replay` takes it.
  std::string scene, bag, settings;
  std::vector<std::string> motions;

  bool of_recording() const { return !scene.empty(); }
};

/// Throws InputError for anything but `[--quick] [--out DIR]`, `[--quick] --shard I/N [--queue DIR]`,
/// `[--out DIR] --merge PART...` or `[--quick] [--out DIR] --scene SCENE (--bag FILE | --motion FILE...)
/// [--settings FILE]`.
ReportOptions parse_report_options(int argc, char** argv);

/// Makes the folder where it is not there. Throws InputError where it cannot be made or written.
void make_folder(const std::string& folder);

}  // namespace spring_workbench::benchmark
