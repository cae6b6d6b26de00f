#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "benchmark/stability_map.h"

namespace spring_workbench::benchmark {

/// The full product of a plan's values for each of its integrators and shapes: the number of cells, and cell `i` before
/// its run.
std::size_t full_map_size(const StabilityPlan& plan);
StabilityRun full_map_cell(const StabilityPlan& plan, std::size_t i);

/// Runs up to `most` cells that are missing from the file at `path`, on all processors, and appends a line for each as
/// soon as it is finished; a truncated last line is run again. Returns all cells of the file, in the order of
/// stability_map(). Throws InputError if the file has other contents or cannot be written.
std::vector<StabilityRun> run_full_map(const StabilityPlan& plan, const std::string& path, std::size_t most,
                                       std::ostream& log);

}  // namespace spring_workbench::benchmark
