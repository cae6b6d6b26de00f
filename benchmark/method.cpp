#include "benchmark/method.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "spring_workbench/validation/run_in_child.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kBound = 1000.0;  // m or rad

/// Header before the outputs.
struct Header {
  double wall_seconds;
  long steps_fallback;
  bool finite;
};

std::string packed(const RunResult& result) {
  const Header header{result.wall_seconds, result.steps_fallback, result.finite};
  std::string data(sizeof(header) + result.outputs.size() * sizeof(Vector3d), '\0');
  std::memcpy(data.data(), &header, sizeof(header));
  if (!result.outputs.empty()) {
    std::memcpy(data.data() + sizeof(header), result.outputs.data(), data.size() - sizeof(header));
  }
  return data;
}

}  // namespace

bool wants_another(const Repetition& repetition, int runs, double spent) {
  return (runs < repetition.runs || spent < repetition.seconds) && spent < kMaxSeconds;
}

RunResult run_isolated(const Method& method, const Scenario& scene, double setting, const Repetition& repetition,
                       double time_limit) {
  const auto start = std::chrono::steady_clock::now();
  const auto data = validation::run_in_child(
      [&] { return packed(fastest(repetition, [&] { return method.run(scene, setting); })); }, {time_limit});
  RunResult result;
  if (!data) {
    result.given_up = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >= time_limit;
    return result;
  }
  Header header{};
  std::memcpy(&header, data->data(), sizeof(header));
  result.wall_seconds = header.wall_seconds;
  result.steps_fallback = header.steps_fallback;
  result.finite = header.finite;
  result.outputs.resize((data->size() - sizeof(header)) / sizeof(Vector3d));
  for (std::size_t i = 0; i < result.outputs.size(); ++i) {
    std::memcpy(result.outputs[i].data(), data->data() + sizeof(header) + i * sizeof(Vector3d), sizeof(Vector3d));
  }
  return result;
}

bool is_bounded(const Vector3d& output) { return output.allFinite() && output.cwiseAbs().maxCoeff() < kBound; }

}  // namespace spring_workbench::benchmark
