#pragma once

#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/validation/run_in_child.h"

namespace spring_workbench::benchmark {

/// Calls these functions, one after the other up to the first whose result is not `finite`, in one child process, so
/// that an engine that aborts, hangs or exhausts memory does not affect the report. Returns a result for each; nothing
/// if the child died or took longer than `time_limit` [s]. The caller must have no other threads.
template <typename Result>
std::optional<std::vector<Result>> results_of_child(const std::vector<std::function<Result()>>& runs,
                                                    double time_limit) {
  using Words = math::StateArchive::Words;
  const auto data = validation::run_in_child(
      [&] {
        std::vector<Result> results;
        for (const auto& run : runs) {
          results.push_back(run());
          if (!results.back().finite) break;
        }
        math::StateArchive archive;
        archive(results);
        const Words& words = archive.words();
        return std::string(reinterpret_cast<const char*>(words.data()), sizeof(Words::value_type) * words.size());
      },
      {time_limit});
  if (!data) return std::nullopt;
  Words words(data->size() / sizeof(Words::value_type));
  std::memcpy(words.data(), data->data(), data->size());
  math::StateArchive archive(words);
  std::vector<Result> results;
  archive(results);
  results.resize(runs.size());
  return results;
}

}  // namespace spring_workbench::benchmark
