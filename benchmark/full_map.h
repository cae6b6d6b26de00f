#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "benchmark/stability_map.h"

namespace spring_workbench::benchmark {

/// The whole product of a plan's values for each of its integrators and shapes: number of its cells, and cell `i`, not
/// run yet.
std::size_t full_map_size(const StabilityPlan& plan);
StabilityRun full_map_cell(const StabilityPlan& plan, std::size_t i);

/// Runs up to `most` cells that the file at `path` does not have yet, on all processors at once, and adds a line for
/// each as soon as it has been run; a last line that was cut off is run again. Returns all cells that the file then
/// has, in the order of stability_map(). Throws InputError where the file has anything else or cannot be written.
std::vector<StabilityRun> run_full_map(const StabilityPlan& plan, const std::string& path, std::size_t most,
                                       std::ostream& log);

}  // namespace spring_workbench::benchmark
