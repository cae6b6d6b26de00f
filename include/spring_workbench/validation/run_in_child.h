#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace spring_workbench::validation {

/// Limits of a child process.
struct ChildLimits {
  double time = 0.0;  ///< processor time [s]; ten times as much wall time is allowed
  std::uint64_t memory = std::numeric_limits<std::uint64_t>::max();  ///< memory beyond that of the caller [bytes]
};

/// Runs `work` in a child process and returns its result, so that a crash, a hang or excessive use of memory does not
/// affect the caller. The child's output is discarded. Returns nothing if the child died, `work` threw, or a limit was
/// exceeded. Only the calling thread exists in the child, so `work` must not wait for other threads. The child has none
/// of the caller's open files and cannot gain privileges by executing a program. If the kernel can filter system calls
/// (on x86-64 and ARM64), it cannot open sockets, write or remove files, execute programs or affect other processes:
/// such calls fail with EPERM. If the kernel cannot, one line on stderr reports it, once. `time_used` receives the
/// child's processor time [s]. Throws InputError if no process can be created.
std::optional<std::string> run_in_child(const std::function<std::string()>& work, const ChildLimits& limits,
                                        double* time_used = nullptr);

}  // namespace spring_workbench::validation
