#include "benchmark/isolated.h"

#include <fcntl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace spring_workbench::benchmark {
namespace {

/// Ends the process when `seconds` are over.
void end_after(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(ITIMER_REAL, &timer, nullptr);
}

bool write_all(int file, const std::string& data) {
  for (std::size_t at = 0; at < data.size();) {
    const ssize_t written = write(file, data.data() + at, data.size() - at);
    if (written <= 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return true;
}

std::string read_all(int file) {
  std::string data;
  std::array<char, 65536> part;
  for (ssize_t got; (got = read(file, part.data(), part.size())) > 0;) data.append(part.data(), static_cast<std::size_t>(got));
  return data;
}

[[noreturn]] void child(int pipe, const std::function<std::string()>& work, double time_limit) {
  const int nowhere = open("/dev/null", O_WRONLY);  // engines print when they fail
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  end_after(time_limit);
  try {
    _exit(write_all(pipe, work()) ? 0 : 1);
  } catch (const std::exception&) {
    _exit(1);
  }
}

}  // namespace

std::optional<std::string> run_in_child(const std::function<std::string()>& work, double time_limit) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a run");
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process for a run");
  if (process == 0) {
    close(ends[0]);
    child(ends[1], work, time_limit);
  }
  close(ends[1]);
  std::string data = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  waitpid(process, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return data;
}

}  // namespace spring_workbench::benchmark
