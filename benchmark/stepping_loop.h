#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>

#include "benchmark/method.h"

namespace spring_workbench::benchmark {

/// Interpolates between the ends of steps by the polynomial of degree five through six of the `values`, which are one
/// step apart; `at`: position in steps from the first value.
inline Vector3d between_steps(const std::vector<Vector3d>& values, double at) {
  constexpr int points = 6;
  const int count = static_cast<int>(values.size()), used = std::min(points, count);
  const int first = std::clamp(static_cast<int>(std::floor(at)) - used / 2 + 1, 0, count - used);
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < used; ++i) {
    double weight = 1.0;
    for (int j = 0; j < used; ++j) {
      if (j != i) weight *= (at - first - j) / (i - j);
    }
    sum += weight * values[static_cast<std::size_t>(first + i)];
  }
  return sum;
}

/// The timed loop of a method with fixed steps of length step_length(): calls `advance(t, h)` for each step from t to t
/// + h, and `output(t)` at the output times or, if steps are longer than the output interval, at the ends of steps, and
/// interpolates between these. Stops at the first output that is not bounded.
template <typename Advance, typename Output>
RunResult stepping_loop(const Scenario& scene, double step, Advance&& advance, Output&& output) {
  const std::vector<double> times = output_times(scene);
  const double h = step_length(scene, step);
  const bool is_long = h > 1.000001 * scene.output_interval;
  const int count = is_long ? 1 : steps_per_output(scene, step);
  const double interval = is_long ? h : scene.output_interval;
  const auto intervals = static_cast<std::size_t>(std::ceil(scene.duration / interval * (1.0 - 1e-9)));
  RunResult result;
  result.outputs.reserve(times.size());
  result.outputs.push_back(output(0.0));
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < intervals; ++i) {
    const double t = static_cast<double>(i) * interval;
    for (int j = 0; j < count; ++j) advance(t + j * h, h);
    const Vector3d value = output(static_cast<double>(i + 1) * interval);
    if (!is_bounded(value)) return result;
    result.outputs.push_back(value);
  }
  if (is_long) {
    const std::vector<Vector3d> ends = std::move(result.outputs);
    result.outputs.clear();
    for (const double t : times) result.outputs.push_back(between_steps(ends, t / h));
  }
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.finite = true;
  return result;
}

}  // namespace spring_workbench::benchmark
