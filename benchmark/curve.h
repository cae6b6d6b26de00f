#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "benchmark/error_table.h"

namespace spring_workbench::benchmark {

/// A measured setting: what it costs and how wrong it is.
struct CurvePoint {
  double run_time = 0.0;
  double error = 0.0;
};

/// The run time that an error of `error` costs: on the front of the points that none beats in both, between its two
/// neighbours by a power law (a straight line in log-log). Where the cheapest point is as good already, its run time;
/// nothing where none is.
std::optional<double> run_time_for_error(std::vector<CurvePoint> points, double error);

/// The error of the cheapest of the points: a line begins there. Infinite for no points.
double first_error(const std::vector<CurvePoint>& points);
/// The least error of the points. Infinite for no points.
double least_error(const std::vector<CurvePoint>& points);

/// Which of the errors of a row.
using ErrorMeasure = double ErrorRow::*;

/// The finite rows that are `wanted`, those to a tolerance that chooses our steps left out.
std::vector<CurvePoint> curve(const std::vector<ErrorRow>& rows, const std::function<bool(const ErrorRow&)>& wanted,
                              ErrorMeasure measure = &ErrorRow::error_over_hand_amplitude);

}  // namespace spring_workbench::benchmark
