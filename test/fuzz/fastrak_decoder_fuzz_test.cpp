#include "fuzz/fastrak_decoder_fuzz.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace {

std::vector<std::string> corpus() {
  std::vector<std::string> inputs;
  for (const auto& entry :
       std::filesystem::directory_iterator(SPRING_WORKBENCH_SOURCE_DIR "/test/fuzz/corpus/fastrak")) {
    std::ifstream file(entry.path(), std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return inputs;
}

void run(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const unsigned char*>(input.data()), input.size());
}

/// The fuzz target aborts where a law is broken. Here it gets the corpus, and a random walk from it.
TEST(FastrakDecoderFuzz, CorpusAndItsMutationsKeepTheLaws) {
  const std::vector<std::string> inputs = corpus();
  ASSERT_GE(inputs.size(), 8u);
  for (const std::string& input : inputs) run(input);
  std::mt19937 random(1);
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  for (int round = 0; round < 20000; ++round) {
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
    run(input);
  }
}

}  // namespace
