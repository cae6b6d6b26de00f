#include "benchmark/curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spring_workbench::benchmark {
namespace {

constexpr double kMinError = 1e-18;  // so that logarithms stay finite

}  // namespace

std::optional<double> run_time_for_error(std::vector<CurvePoint> points, double error) {
  std::sort(points.begin(), points.end(), [](const CurvePoint& a, const CurvePoint& b) {
    return a.run_time < b.run_time || (a.run_time == b.run_time && a.error < b.error);
  });
  const CurvePoint* before = nullptr;  // the last point of the front
  for (const CurvePoint& point : points) {
    if (before != nullptr && point.error >= before->error) continue;
    if (point.error <= error) {
      if (before == nullptr) return point.run_time;
      const double from = std::log(before->error), to = std::log(std::max(point.error, kMinError));
      const double share = (from - std::log(error)) / (from - to);
      return before->run_time * std::pow(point.run_time / before->run_time, share);
    }
    before = &point;
  }
  return std::nullopt;
}

std::optional<double> least_run_time_within(const std::vector<CurvePoint>& points, double error) {
  std::optional<double> least;
  for (const CurvePoint& point : points) {
    if (point.error <= error) least = std::min(least.value_or(point.run_time), point.run_time);
  }
  return least;
}

double first_error(const std::vector<CurvePoint>& points) {
  const auto cheapest = std::min_element(
      points.begin(), points.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.run_time < b.run_time; });
  return cheapest == points.end() ? std::numeric_limits<double>::infinity() : cheapest->error;
}

double min_error(const std::vector<CurvePoint>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const CurvePoint& point : points) least = std::min(least, point.error);
  return least;
}

std::vector<CurvePoint> curve(const std::vector<ErrorRow>& rows, const std::function<bool(const ErrorRow&)>& wanted,
                              ErrorMeasure measure) {
  std::vector<CurvePoint> points;
  for (const ErrorRow& row : rows) {
    if (!row.finite || row.error_over_tolerance > 0.0 || !wanted(row)) continue;
    points.push_back({row.wall_us_per_simulated_second, row.*measure});
  }
  return points;
}

}  // namespace spring_workbench::benchmark
