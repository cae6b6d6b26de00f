#pragma once

#include <string>
#include <vector>

#include "benchmark/curve.h"
#include "benchmark/elastica.h"
#include "benchmark/stability_map.h"
#include "benchmark/step_cost.h"

namespace spring_workbench::benchmark {

/// Run time [µs per simulated second] for reaching the error `error` in `measure`, for each scene by title_of()
/// (columns) and method (rows), as CSV; "-" if no setting reaches it.
std::string run_time_for_error_csv(const std::vector<ErrorRow>& rows, double error, ErrorMeasure measure);

/// Rod cases (rows) by integrator (columns): error relative to the largest deflection with one step per sample, and its
/// cost, for one shape.
std::string one_step_per_sample_csv(const std::vector<ErrorRow>& rods, const std::string& shape);

/// Shape models side by side: error of the model at some loads, cost of an evaluation of the equation of motion, and,
/// for `exponential` with one step per sample, error of integration and run time on the case with the largest bends.
std::string shapes_csv(const std::vector<ElasticaRow>& elastica, const std::vector<ErrorRow>& rods);

/// Cost of each part of a step (columns: shape model and coordinates) [ns].
std::string step_cost_csv(const std::vector<StepCost>& costs);

/// Cells of the map by integrator and shape.
std::string map_summary_csv(const StabilityMap& map);

/// Processor time of each unit of the report, and the sum for each part [s].
std::string unit_times_csv(const std::vector<UnitTime>& times);
std::string times_by_part_csv(const std::vector<UnitTime>& times);

}  // namespace spring_workbench::benchmark
