#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "benchmark/error_table.h"

namespace spring_workbench::benchmark {

/// A measured setting: its cost and its error.
struct CurvePoint {
  double run_time = 0.0;
  double error = 0.0;
};

/// Run time at which an error of `error` is reached, interpolated on the Pareto front of the points by a power law (a
/// straight line in log-log). If the cheapest point already reaches it, its run time; nothing if no point does.
std::optional<double> run_time_for_error(std::vector<CurvePoint> points, double error);

/// Run time of the cheapest point with at most this error; nothing if there is none.
std::optional<double> least_run_time_within(const std::vector<CurvePoint>& points, double error);

/// Error of the cheapest point, where a curve begins. Infinite if there are no points.
double first_error(const std::vector<CurvePoint>& points);
/// Smallest error of the points. Infinite if there are no points.
double min_error(const std::vector<CurvePoint>& points);

/// One of the errors of a row.
using ErrorMeasure = double ErrorRow::*;

/// The finite rows that are `wanted`, except runs of ours to a tolerance.
std::vector<CurvePoint> curve(const std::vector<ErrorRow>& rows, const std::function<bool(const ErrorRow&)>& wanted,
                              ErrorMeasure measure = &ErrorRow::error_over_hand_amplitude);

}  // namespace spring_workbench::benchmark
