#pragma once

#include <string>
#include <vector>

#include "benchmark/error_table.h"

namespace spring_workbench::benchmark {

/// Draws `error_against_run_time_<scene>.png` into `folder` for every scene in the table `csv`, by the Python script
/// that stands beside the package. The paths of those that came about: none without Python 3 and matplotlib, which the
/// script says on stderr.
std::vector<std::string> draw_pictures(const std::string& csv, const std::vector<ErrorRow>& rows,
                                       const std::string& folder);

}  // namespace spring_workbench::benchmark
