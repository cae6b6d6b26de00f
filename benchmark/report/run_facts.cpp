#include "benchmark/report/run_facts.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace spring_workbench::benchmark {
namespace {

constexpr double kQuiet = 0.5;  // load average per processor

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.compare(0, 10, "model name") == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string machine() {
  return processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " processors";
}

/// Load average of the last minute; negative if unknown.
double load_average() {
  double average[1];
  return getloadavg(average, 1) == 1 ? average[0] : -1.0;
}

std::string load() {
  const double average = load_average();
  if (average < 0.0) return "unknown";
  std::ostringstream text;
  text.precision(2);
  text << std::fixed << average << " at the start";
  return text.str();
}

std::string now() {
  const std::time_t t = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", std::gmtime(&t));
  return text;
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

std::string command_of(int argc, char** argv) {
  std::string text = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) text += std::string(" ") + argv[i];
  return text;
}

std::string load_warning() {
  const double average = load_average();
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  if (average <= kQuiet * processors) return {};
  std::ostringstream text;
  text << "This was not a quiet machine: its load average at the start was " << average << " on " << processors
       << " processors. The run times here are too long; errors and stability are what they are.";
  return text.str();
}

std::vector<RunFact> run_facts(const std::string& command, const std::string& commit, const Baselines& baselines) {
  return {{"machine", machine()},
          {"load", load()},
          {"compiler", SPRING_WORKBENCH_COMPILER},
          {"flags", SPRING_WORKBENCH_FLAGS},
          {"date", now()},
          {"command", command},
          {"commit", commit},
          {"baselines found", list(baselines.found)},
          {"baselines not found", list(baselines.not_found)}};
}

std::string as_csv_header(const std::vector<RunFact>& facts) {
  std::string text;
  for (const RunFact& fact : facts) text += "# " + fact.name + ": " + fact.value + '\n';
  return text;
}

}  // namespace spring_workbench::benchmark
