#include "benchmark/method.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string_view>

#include "spring_workbench/validation/run_in_child.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kBound = 1000.0;  // m or rad

/// Header before the outputs.
struct Header {
  double wall_seconds;
  long steps_fallback;
  bool finite;
  std::size_t outputs;
};

void pack(const RunResult& result, std::string& data) {
  const Header header{result.wall_seconds, result.steps_fallback, result.finite, result.outputs.size()};
  data.append(reinterpret_cast<const char*>(&header), sizeof(header));
  data.append(reinterpret_cast<const char*>(result.outputs.data()), header.outputs * sizeof(Vector3d));
}

/// Takes a result from the front of the data.
RunResult unpack(std::string_view& data) {
  Header header{};
  std::memcpy(&header, data.data(), sizeof(header));
  data.remove_prefix(sizeof(header));
  RunResult result;
  result.wall_seconds = header.wall_seconds;
  result.steps_fallback = header.steps_fallback;
  result.finite = header.finite;
  for (std::size_t i = 0; i < header.outputs; ++i) {
    result.outputs.emplace_back();
    std::memcpy(result.outputs.back().data(), data.data(), sizeof(Vector3d));
    data.remove_prefix(sizeof(Vector3d));
  }
  return result;
}

}  // namespace

bool wants_another(const Repetition& repetition, int runs, double spent) {
  return (runs < repetition.runs || spent < repetition.seconds) && spent < kMaxSeconds;
}

std::vector<RunResult> run_isolated(const std::vector<std::function<RunResult()>>& runs, double time_limit) {
  const auto start = std::chrono::steady_clock::now();
  const auto data = validation::run_in_child(
      [&] {
        std::string all;
        for (const auto& run : runs) {
          const RunResult result = run();
          pack(result, all);
          if (!result.finite) break;
        }
        return all;
      },
      {time_limit});
  std::vector<RunResult> results(runs.size());
  if (data) {
    std::string_view rest = *data;
    for (std::size_t i = 0; !rest.empty(); ++i) results[i] = unpack(rest);
    return results;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (RunResult& result : results) result.given_up = seconds >= time_limit;
  return results;
}

RunResult run_isolated(const Method& method, const Scenario& scene, double setting, const Repetition& repetition,
                       double time_limit) {
  return run_isolated({[&] { return fastest(repetition, [&] { return method.run(scene, setting); }); }}, time_limit)[0];
}

bool is_bounded(const Vector3d& output) { return output.allFinite() && output.cwiseAbs().maxCoeff() < kBound; }

}  // namespace spring_workbench::benchmark
