#include "benchmark/report/pictures.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace spring_workbench::benchmark {
namespace {

/// In the devel space as after installation: `lib/spring_workbench/report` and `share/spring_workbench/…`.
std::string script() {
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe");
  return executable.parent_path().parent_path().parent_path() / "share" / "spring_workbench" / "plot_error_table.py";
}

/// Whether the program ran and ended well.
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

std::vector<std::string> draw_pictures(const std::string& csv, const std::vector<ErrorRow>& rows,
                                       const std::string& folder) {
  std::vector<std::string> scenes, pictures;
  for (const ErrorRow& row : rows) {
    if (std::find(scenes.begin(), scenes.end(), row.scene) == scenes.end()) scenes.push_back(row.scene);
  }
  for (const std::string& scene : scenes) {
    const std::string picture = std::filesystem::path(folder) / ("error_against_run_time_" + scene + ".png");
    if (!run({SPRING_WORKBENCH_PYTHON, script(), csv, picture, scene})) {
      std::cerr << "report: no picture of scene " << scene
                << ": python3 with matplotlib (python3-matplotlib) draws it\n";
      continue;
    }
    pictures.push_back(picture);
  }
  return pictures;
}

}  // namespace spring_workbench::benchmark
