#pragma once

#include <ostream>
#include <string>

#include "benchmark/report/options.h"

namespace spring_workbench::benchmark {

/// Measures everything, writes tables, pictures and the page into `options.out`, the checks to `out` and the progress
/// to `log`. Throws std::runtime_error where a file cannot be written or a reference solution fails.
void make_report(const ReportOptions& options, const std::string& command, std::ostream& out, std::ostream& log);

}  // namespace spring_workbench::benchmark
