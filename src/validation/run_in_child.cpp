#include "spring_workbench/validation/run_in_child.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <mutex>

#include "confine.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::validation {
namespace {

/// Prefix of the child's result: whether it was confined.
constexpr char confined[] = "+", unconfined[] = "-";

void warn_once_of_unconfined() {
  static std::once_flag said;
  std::call_once(said, [] {
    std::cerr << "warning: child processes that read files are not confined: no seccomp filter could be installed\n";
  });
}

/// Kills the process with `signal`, whatever handler the caller installed, after `seconds` of the timer.
void end_after(double seconds, decltype(ITIMER_REAL) timer, int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t mask;
  sigemptyset(&mask);
  sigaddset(&mask, signal);
  sigprocmask(SIG_UNBLOCK, &mask, nullptr);
  itimerval value{};
  value.it_value.tv_sec = static_cast<time_t>(seconds);
  value.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(timer, &value, nullptr);
}

/// Limits the growth of the address space to `more` bytes, and disables core files.
void limit_memory(std::uint64_t more) {
  const rlimit none{};
  setrlimit(RLIMIT_CORE, &none);
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const std::uint64_t now = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  if (more < limit.rlim_max - now) limit.rlim_cur = now + more;
  setrlimit(RLIMIT_AS, &limit);
}

bool write_all(int file, const std::string& data) {
  for (std::size_t at = 0; at < data.size();) {
    const ssize_t written = write(file, data.data() + at, data.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return true;
}

std::string read_all(int file) {
  std::string data;
  std::array<char, 65536> part{};
  for (;;) {
    const ssize_t got = read(file, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return data;
    data.append(part.data(), static_cast<std::size_t>(got));
  }
}

[[noreturn]] void child(int pipe, const std::function<std::string()>& work, const ChildLimits& limits) {
  const int nowhere = open("/dev/null", O_RDWR);  // libraries print messages on failure
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  try {
    keep_alone(pipe);
    end_after(limits.time, ITIMER_PROF, SIGPROF);
    end_after(10.0 * limits.time, ITIMER_REAL, SIGALRM);  // a blocked child uses no processor time
    limit_memory(limits.memory);
    const char* const is_confined = confine() ? confined : unconfined;
    _exit(write_all(pipe, is_confined) && write_all(pipe, work()) ? 0 : 1);
  } catch (const std::exception&) {
    _exit(1);
  }
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

[[noreturn]] void refuse_without_child(int reason) {
  throw InputError(std::string("child process: cannot be created (") + std::strerror(reason) +
                   "); files are read in a child process, so that a bad file does no harm");
}

}  // namespace

std::optional<std::string> run_in_child(const std::function<std::string()>& work, const ChildLimits& limits,
                                        double* time_used) {
  int ends[2];
  if (pipe(ends) != 0) refuse_without_child(errno);
  const pid_t process = fork();
  if (process < 0) {
    const int reason = errno;
    close(ends[0]);
    close(ends[1]);
    refuse_without_child(reason);
  }
  if (process == 0) {
    close(ends[0]);
    child(ends[1], work, limits);
  }
  close(ends[1]);
  std::string data = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  rusage usage{};
  while (wait4(process, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  if (time_used != nullptr) *time_used = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  if (data.compare(0, 1, unconfined) == 0) warn_once_of_unconfined();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  data.erase(0, 1);
  return data;
}

}  // namespace spring_workbench::validation
