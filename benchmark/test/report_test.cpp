#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "benchmark/report/html.h"
#include "benchmark/report/page.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/names.h"
#include "support/paths.h"
#include "test/support/temporary_folder.h"

namespace spring_workbench::benchmark::report_test {
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

TEST(Page, PutsNoMarkupFromFactsIntoThePage) {
  PageContents contents;
  contents.facts = {{"command", "report --out <b>&"}};
  EXPECT_NE(html_page(contents).find("report --out &lt;b&gt;&amp;"), std::string::npos);
}

TEST(Page, TablesHaveACellForEachOfTheCsvQuotedOrNot) {
  std::ostringstream out;
  add_table("a,b\n\"x, \"\"y\"\"\",PASS\n,FAIL\n", out);
  const std::string html = out.str();
  for (const char* cell : {"<th>a</th><th>b</th>", "<td>x, &quot;y&quot;</td><td class=\"held\">PASS</td>",
                           "<td></td><td class=\"failed\">FAIL</td>"}) {
    EXPECT_NE(html.find(cell), std::string::npos) << html;
  }
}

struct Outcome {
  int code;
  std::string output;  ///< both streams
};

Outcome report(const std::string& arguments) {
  FILE* pipe = popen(("'" + test_support::program("report") + "' " + arguments + " 2>&1").c_str(), "r");
  Outcome outcome{-1, {}};
  if (pipe == nullptr) return outcome;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) outcome.output += static_cast<char>(c);
  outcome.code = WEXITSTATUS(pclose(pipe));
  return outcome;
}

TEST(Report, HelpNamesEveryOption) {
  const Outcome outcome = report("--help");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  for (const char* option : {"--quick", "--out", "--commit", "--shard", "--queue", "--merge", "--scene", "--bag",
                             "--motion", "--settings"}) {
    EXPECT_NE(outcome.output.find(option), std::string::npos) << option;
  }
}

TEST(Report, RefusesBadArgumentsInOneLineThatNamesArgumentValueAndRule) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"--fast", {"--fast: unknown option", "--help"}},
      {"--quick now", {"now: unknown option", "--help"}},
      {"--out", {"--out: expected a folder"}},
      {"--shard", {"--shard: expected I/N"}},
      {"--shard 0/3", {"--shard: invalid value '0/3': expected I/N"}},
      {"--shard 4/3", {"--shard", "4/3", "I/N"}},
      {"--shard 1/2/3", {"--shard", "1/2/3", "I/N"}},
      {"--shard 1/2 --out /tmp", {"--shard, --out", "cannot be given together"}},
      {"--shard 1/2 --queue", {"--queue: expected a folder"}},
      {"--queue .", {"--queue: can only be given together with --shard"}},
      {"--commit", {"--commit: expected the name"}},
      {"--merge", {"--merge: expected the files"}},
      {"--quick --merge /dev/null", {"--merge", "--quick", "the files"}},
      {"--out ''", {"--out: expected a folder"}},
      {"--bag", {"--bag: expected a path"}},
      {"--bag x.bag", {"--scene, --bag, --motion: expected a scene together"}},
      {"--scene s.urdf", {"--scene, --bag, --motion: expected a scene together"}},
      {"--settings s.yaml", {"--settings: can only be given together with --scene"}},
      {"--scene s.urdf --bag x.bag --shard 1/2", {"--scene: cannot be given together with --shard"}},
      {"--out /dev/null/x", {"--out", "/dev/null/x", "folder"}},
  };
  for (const auto& [arguments, words] : cases) {
    const Outcome outcome = report(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    for (const std::string& word : words) EXPECT_NE(outcome.output.find(word), std::string::npos) << outcome.output;
  }
}

/// The tables and pages that the report's documentation lists.
std::vector<std::string> promised_files() {
  std::ifstream readme(test_support::checkout("benchmark/README.md"));
  std::vector<std::string> names;
  for (std::string line; std::getline(readme, line);) {
    const std::size_t end = line.find('`', 3);
    if (line.rfind("| `", 0) != 0 || end == std::string::npos) continue;
    const std::string name = line.substr(3, end - 3), kind = std::filesystem::path(name).extension();
    if (name[0] != '*' && (kind == ".csv" || kind == ".html")) names.push_back(name);
  }
  return names;
}

TEST(Report, QuickByTwoShardsOfAQueueWritesAllThatIsPromised) {
  const test_support::TemporaryFolder folder;
  const std::string queue = folder.path("queue"), one = folder.path("1"), two = folder.path("2");
  std::filesystem::create_directory(queue);
  const std::string program = "'" + test_support::program("report") + "'",
                    quick = " --quick --commit abc123 --queue '" + queue + "'";
  const Outcome shards = report(quick + " --shard 1/2 2>&1 >'" + one + "' & " + program + quick + " --shard 2/2 >'" +
                                two + "' 2>/dev/null; wait $! #");
  ASSERT_EQ(shards.code, 0) << shards.output;
  const Outcome merged = report("--out '" + folder.path("out") + "' --merge '" + one + "' '" + two + "'");
  ASSERT_EQ(merged.code, 0) << merged.output;
  const std::vector<std::string> names = promised_files();
  EXPECT_GE(names.size(), 15U);
  for (const std::string& name : names) {
    std::ifstream file(folder.path("out/" + name));
    EXPECT_EQ(file.good(), name != "stability_counts.csv") << name;  // which a quick report leaves out
    int lines = 0;
    bool has_commit = name == "report.html" || name == "stability_counts.csv";
    for (std::string line; std::getline(file, line); has_commit = has_commit || line == "# commit: abc123")
      lines += line[0] != '#';
    EXPECT_TRUE(has_commit) << name;
    EXPECT_TRUE(lines > 1 || name == "stability_counts.csv" || name == "stability_failures.csv") << name;
  }
  for (const char* word : {"PASS", "FAIL", "report --quick", "Stability map, exponential"})
    EXPECT_NE(merged.output.find(word), std::string::npos) << word;
}

TEST(Report, ARecordingHasALineForEachIntegratorAndStepWhoseErrorFallsWithIt) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("report_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream motion(folder / "hand.tum");
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.02 * i;
    motion << t << ' ' << 0.05 * std::sin(8.0 * t) << " 0 " << 0.5 + 0.02 * std::sin(11.0 * t) << " 0 1 0 0\n";
  }
  motion.close();
  std::ofstream(folder / "own settings.yaml")
      << "{contact: none, grasp: {object: box, tip_in_object: [0, 0, 0, 0, 1, 0, 0]}, start: {follow: true}}\n";
  const Outcome outcome = report("--quick --scene '" + test_support::checkout("scenes/single_box.urdf") +
                                 "' --motion '" + (folder / "hand.tum").string() + "' --settings '" +
                                 (folder / "own settings.yaml").string() + "' --out '" + folder.string() + "'");
  ASSERT_EQ(outcome.code, 0) << outcome.output;
  std::ifstream table(folder / "recording.csv");
  std::map<std::string, std::vector<double>> errors;
  for (std::string line; std::getline(table, line);) {
    if (line[0] == '#' || line.rfind("integrator,", 0) == 0) continue;
    std::istringstream in(line);
    std::string name, step, error;
    std::getline(in, name, ',');
    std::getline(in, step, ',');
    std::getline(in, error, ',');
    errors[name].push_back(std::stod(error));
  }
  EXPECT_EQ(errors.size(), validation::names<dynamics::IntegratorKind>().size());
  for (const auto& [name, of_it] : errors) {
    ASSERT_EQ(of_it.size(), 2U) << name;
    const auto kind = validation::named<dynamics::IntegratorKind>(name, "test", "integrator");
    if (!dynamics::make_integrator(kind)->stiffly_stable()) continue;
    EXPECT_LT(of_it[1], of_it[0]) << name;
  }
  EXPECT_LT(errors.at("exponential")[1], 1e-6);
  EXPECT_GT(errors.at("implicit_euler")[1], 1e-5);
  std::filesystem::remove_all(folder);
}

TEST(Report, ARecordingThatReplayRefusesIsRefusedInOneLineAndLeavesNothing) {
  const test_support::TemporaryFolder folder;
  const std::string out = folder.path("a/b");
  const std::string motion = test_support::checkout("config/mini_world_demo.yaml");
  const std::pair<std::string, std::string> cases[] = {
      {"--scene /nowhere.urdf --motion /nowhere.tum",
       "/nowhere.tum: expected a readable motion file (No such file or directory)"},
      {"--scene /nowhere.urdf --motion '" + motion + "'",
       "command line: --scene: invalid value '/nowhere.urdf': expected a readable file (No such file or directory)"},
      {"--scene /nowhere.urdf --motion '" + motion + "' --settings /nowhere.yaml",
       "/nowhere.yaml: expected a readable YAML file (No such file or directory)"}};
  for (const auto& [arguments, message] : cases) {
    const Outcome outcome = report(arguments + " --out '" + out + "'");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.output, "report: " + message + "\n");
    EXPECT_FALSE(std::filesystem::exists(folder.path("a")));
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark::report_test
