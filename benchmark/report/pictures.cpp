#include "benchmark/report/pictures.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

namespace spring_workbench::benchmark {
namespace {

/// Path of the script, which is the same relative to `report` in the build and after installation.
std::string script() {
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe");
  return executable.parent_path() / SPRING_WORKBENCH_TO_SHARE / "plot_report.py";
}

/// Runs a program; returns whether it succeeded.
bool run(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t process = 0;
  if (posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return false;
  int status = 0;
  return waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::string draw(const Picture& picture, const std::string& folder) {
  const std::string path = std::filesystem::path(folder) / picture.name;
  std::vector<std::string> words = {SPRING_WORKBENCH_PYTHON, script(), picture.kind, picture.table, path};
  words.insert(words.end(), picture.others.begin(), picture.others.end());
  if (run(words)) return path;
  std::cerr << "report: no picture " << picture.name << ": python3 with matplotlib (python3-matplotlib) draws it\n";
  return {};
}

}  // namespace spring_workbench::benchmark
