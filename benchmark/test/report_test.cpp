#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <tuple>

#include "benchmark/report/page.h"

namespace spring_workbench::benchmark {
namespace {

std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits >= 8) out += static_cast<char>(group >> (bits -= 8) & 255U);
  }
  return out;
}

TEST(Page, Base64ComesBackForBytesOfAnyLength) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> byte(0, 255);
  for (std::size_t length = 0; length < 50; ++length) {
    std::string bytes;
    for (std::size_t i = 0; i < length; ++i) bytes += static_cast<char>(byte(random));
    EXPECT_EQ(base64(bytes).size() % 4, 0U);
    EXPECT_EQ(decoded(base64(bytes)), bytes);
  }
}

TEST(Page, RunTimeForAnErrorIsTheLeastOfTheRunsThatReachIt) {
  ErrorRow row;
  row.scene = "C";
  row.stiffness_factor = 100.0;
  row.method = "m";
  std::vector<ErrorRow> rows;
  for (const auto& [error, time, finite] :
       {std::tuple{1e-2, 1.0, true}, {1e-7, 70.0, true}, {1e-8, 50.0, true}, {0.0, 2.0, false}}) {
    row.error_over_hand_amplitude = error;
    row.wall_us_per_simulated_second = time;
    row.finite = finite;
    rows.push_back(row);
  }
  EXPECT_EQ(run_time_for_error_csv(rows, 1e-6), "method,C × 100\nm,50\n");
  EXPECT_EQ(run_time_for_error_csv(rows, 1e-1), "method,C × 100\nm,1\n");
  EXPECT_EQ(run_time_for_error_csv(rows, 1e-9), "method,C × 100\nm,-\n");
}

TEST(Page, PutsNoMarkupFromFactsIntoThePage) {
  PageContents contents;
  contents.facts = {{"command", "report --out <b>&"}};
  EXPECT_NE(html_page(contents).find("report --out &lt;b&gt;&amp;"), std::string::npos);
}

struct Outcome {
  int code;
  std::string output;  ///< both streams
};

Outcome report(const std::string& arguments) {
  FILE* pipe = popen(("'" REPORT_EXECUTABLE "' " + arguments + " 2>&1").c_str(), "r");
  Outcome outcome{-1, {}};
  if (pipe == nullptr) return outcome;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) outcome.output += static_cast<char>(c);
  outcome.code = WEXITSTATUS(pclose(pipe));
  return outcome;
}

TEST(Report, RefusesBadArgumentsInOneLineThatNamesArgumentValueAndRule) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"--fast", {"--fast", "--quick"}},
      {"--quick now", {"now", "--quick"}},
      {"--out", {"--out", "(nothing)", "folder"}},
      {"--out ''", {"--out", "(nothing)", "folder"}},
      {"--out /dev/null/x", {"--out", "/dev/null/x", "folder"}},
  };
  for (const auto& [arguments, words] : cases) {
    const Outcome outcome = report(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    for (const std::string& word : words) EXPECT_NE(outcome.output.find(word), std::string::npos) << outcome.output;
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark
