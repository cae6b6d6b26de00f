#pragma once

#include <string>

namespace spring_workbench::benchmark {

/// What `report` was asked for.
struct ReportOptions {
  bool quick = false;          ///< few scenes and settings, no stability counts
  std::string out = "report";  ///< folder to write to; made where it is not there
};

/// Throws InputError for anything but `[--quick] [--out DIR]`, and where DIR cannot be made or written.
ReportOptions parse_report_options(int argc, char** argv);

}  // namespace spring_workbench::benchmark
