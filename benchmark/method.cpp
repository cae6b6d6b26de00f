#include "benchmark/method.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace spring_workbench::benchmark {
namespace {

constexpr double kBound = 1000.0;  // m or rad

/// What goes through the pipe before the outputs.
struct Header {
  double wall_seconds;
  std::size_t count;
  bool finite;
};

bool write_all(int file, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(file, at, size);
    if (written <= 0) return false;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool read_all(int file, void* data, std::size_t size) {
  char* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = read(file, at, size);
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

RunResult run_repeatedly(const Method& method, const Scenario& scene, double setting, const Repetition& repetition) {
  RunResult best = method.run(scene, setting);
  double spent = best.wall_seconds;
  for (int runs = 1; best.finite && wants_another(repetition, runs, spent); ++runs) {
    const RunResult again = method.run(scene, setting);
    spent += again.wall_seconds;
    best.wall_seconds = std::min(best.wall_seconds, again.wall_seconds);
  }
  return best;
}

[[noreturn]] void child(int pipe, const Method& method, const Scenario& scene, double setting,
                        const Repetition& repetition, double time_limit) {
  const int nowhere = open("/dev/null", O_WRONLY);  // engines print when they fail
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  alarm(static_cast<unsigned>(std::ceil(time_limit)));
  try {
    const RunResult result = run_repeatedly(method, scene, setting, repetition);
    const Header header{result.wall_seconds, result.outputs.size(), result.finite};
    const bool sent = write_all(pipe, &header, sizeof(header)) &&
                      write_all(pipe, result.outputs.data(), result.outputs.size() * sizeof(Vector3d));
    _exit(sent ? 0 : 1);
  } catch (const std::exception&) {
    _exit(1);
  }
}

}  // namespace

bool wants_another(const Repetition& repetition, int runs, double spent) {
  return (runs < repetition.runs || spent < repetition.seconds) && spent < kMostSeconds;
}

RunResult run_isolated(const Method& method, const Scenario& scene, double setting, const Repetition& repetition,
                       double time_limit) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a run of " + method.name());
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process for a run of " + method.name());
  if (process == 0) {
    close(ends[0]);
    child(ends[1], method, scene, setting, repetition, time_limit);
  }
  close(ends[1]);
  RunResult result;
  Header header{};
  if (read_all(ends[0], &header, sizeof(header))) {
    result.outputs.resize(header.count);
    result.finite = read_all(ends[0], result.outputs.data(), header.count * sizeof(Vector3d)) && header.finite;
    result.wall_seconds = header.wall_seconds;
  }
  close(ends[0]);
  waitpid(process, nullptr, 0);
  return result;
}

bool is_bounded(const Vector3d& output) { return output.allFinite() && output.cwiseAbs().maxCoeff() < kBound; }

}  // namespace spring_workbench::benchmark
