#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "fuzz/targets.h"
#include "support/paths.h"

namespace spring_workbench::fuzz {
namespace {

struct Target {
  const char* name;  // of the corpus, too
  void (*run)(std::string_view);
  int mutations;  // number per seed, for a few seconds of run time
};
std::ostream& operator<<(std::ostream& out, const Target& target) { return out << target.name; }

std::vector<std::string> corpus(const std::string& name) {
  std::set<std::filesystem::path> paths;  // in order
  for (const auto& entry : std::filesystem::directory_iterator(test_support::checkout("test/fuzz/corpus/") + name)) {
    paths.insert(entry.path());
  }
  std::vector<std::string> inputs;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return inputs;
}

/// A target aborts if a requirement is violated. It is run on its corpus and on seeded random mutations of it.
class Fuzz : public testing::TestWithParam<std::tuple<Target, unsigned>> {};

TEST_P(Fuzz, CorpusAndItsMutationsKeepTheLaws) {
  const auto& [target, seed] = GetParam();
  const std::vector<std::string> inputs = corpus(target.name);
  ASSERT_GE(inputs.size(), 4u);
  for (const std::string& input : inputs) target.run(input);
  std::mt19937 random(seed);
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  for (int round = 0; round < target.mutations; ++round) {
    std::string input = inputs[below(inputs.size())];
    for (std::size_t hits = 1 + below(6); hits > 0 && !input.empty(); --hits) {
      const std::size_t at = below(input.size());
      switch (below(4)) {
        case 0:
          input[at] = static_cast<char>(below(256));
          break;
        case 1:
          input.erase(at, 1 + below(40));
          break;
        case 2:
          input.insert(at, 1, static_cast<char>(below(256)));
          break;
        default: {
          const std::string& other = inputs[below(inputs.size())];
          input.insert(at, other.substr(below(other.size()), 1 + below(80)));
        }
      }
    }
    target.run(input);
  }
}

std::string name_of(const testing::TestParamInfo<std::tuple<Target, unsigned>>& instance) {
  return std::get<0>(instance.param).name + std::to_string(std::get<1>(instance.param));
}

INSTANTIATE_TEST_SUITE_P(
    Bytes, Fuzz,
    testing::Combine(testing::Values(Target{"fastrak", fastrak, 20000}, Target{"motion", motion, 4000},
                                     Target{"settings", settings, 1000}, Target{"scene", scene, 1000}),
                     testing::Range(1u, 4u)),
    name_of);
INSTANTIATE_TEST_SUITE_P(Services, Fuzz,
                         testing::Combine(testing::Values(Target{"calls", calls, 60}), testing::Range(1u, 5u)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Rods, Fuzz,
                         testing::Combine(testing::Values(Target{"steps", steps, 60}), testing::Range(1u, 5u)),
                         name_of);

}  // namespace
}  // namespace spring_workbench::fuzz
