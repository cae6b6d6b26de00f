#include "benchmark/report/run_facts.h"

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace spring_workbench::benchmark {
namespace {

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

/// Above one, other work has taken part of the machine: the timings are then upper bounds.
std::string load() {
  double average[1];
  if (getloadavg(average, 1) != 1) return "unknown";
  std::ostringstream text;
  text.precision(2);
  text << std::fixed << average[0] << " at the start"
       << (average[0] < 1.0 ? "" : ": not a quiet machine, the timings are too long");
  return text.str();
}

std::string now() {
  const std::time_t t = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", std::gmtime(&t));
  return text;
}

std::string command(int argc, char** argv) {
  std::string text = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) text += std::string(" ") + argv[i];
  return text;
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

std::vector<RunFact> run_facts(int argc, char** argv, const Peers& peers) {
  return {{"machine", machine()},
          {"load", load()},
          {"compiler", SPRING_WORKBENCH_COMPILER},
          {"flags", SPRING_WORKBENCH_FLAGS},
          {"date", now()},
          {"command", command(argc, argv)},
          {"peers found", list(peers.found)},
          {"peers not found", list(peers.not_found)}};
}

std::string as_csv_header(const std::vector<RunFact>& facts) {
  std::string text;
  for (const RunFact& fact : facts) text += "# " + fact.name + ": " + fact.value + '\n';
  return text;
}

}  // namespace spring_workbench::benchmark
