#pragma once

#include <chrono>

#include "benchmark/method.h"

namespace spring_workbench::benchmark {

/// The timed loop of a method with fixed steps: calls `advance(t, h)` for each step from t to t + h, all of one length
/// that divides the output interval and is at most `step` [s], and `output(t)` at the output times. Stops at the first
/// output that is not bounded.
template <typename Advance, typename Output>
RunResult stepping_loop(const Scenario& scene, double step, Advance&& advance, Output&& output) {
  const std::vector<double> times = output_times(scene);
  const int count = steps_per_output(scene, step);
  const double h = scene.output_interval / count;
  RunResult result;
  result.outputs.reserve(times.size());
  result.outputs.push_back(output(0.0));
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    for (int j = 0; j < count; ++j) advance(times[i] + j * h, h);
    const Vector3d value = output(times[i + 1]);
    if (!is_bounded(value)) return result;
    result.outputs.push_back(value);
  }
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.finite = true;
  return result;
}

}  // namespace spring_workbench::benchmark
