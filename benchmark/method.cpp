#include "benchmark/method.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "benchmark/child_runs.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kBound = 1000.0;  // m or rad

}  // namespace

bool wants_another(const Repetition& repetition, int runs, double spent) {
  return (runs < repetition.runs || spent < repetition.seconds) && spent < kMaxSeconds;
}

std::vector<RunResult> run_isolated(const std::vector<std::function<RunResult()>>& runs, double time_limit) {
  const auto start = std::chrono::steady_clock::now();
  time_limit *= static_cast<double>(runs.size());
  if (auto results = results_of_child(runs, time_limit)) return std::move(*results);
  RunResult died;
  died.given_up = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >= time_limit;
  return std::vector<RunResult>(runs.size(), died);
}

RunResult run_isolated(const Method& method, const Scenario& scene, double setting, const Repetition& repetition,
                       double time_limit) {
  return run_isolated({[&] { return fastest(repetition, [&] { return method.run(scene, setting); }); }}, time_limit)[0];
}

bool is_bounded(const Vector3d& output) { return output.allFinite() && output.cwiseAbs().maxCoeff() < kBound; }

}  // namespace spring_workbench::benchmark
