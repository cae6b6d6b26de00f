#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace spring_workbench::validation {

/// Limits of a child process.
struct ChildLimits {
  double time = 0.0;  ///< processor time; ten times as much wall time [s]
  std::uint64_t memory = std::numeric_limits<std::uint64_t>::max();  ///< more than the caller has [bytes]
};

/// Runs `work` in a child process, whose output is discarded, and returns its result: a crash, a hang or excessive
/// memory there does not affect the caller. Returns nothing if the child died, `work` threw, or a limit was hit. The
/// child has only the calling thread: `work` must not wait for others. It has none of the caller's open files, and gets
/// no rights by running a program. Where the kernel can filter calls (on x86-64 and ARM64), it can open no socket,
/// write or remove no file, run no program and touch no other process: these fail with EPERM. Where it cannot, one line
/// on stderr says so, once. `time_used` receives its processor time [s]. Throws InputError if no process can be
/// created.
std::optional<std::string> run_in_child(const std::function<std::string()>& work, const ChildLimits& limits,
                                        double* time_used = nullptr);

}  // namespace spring_workbench::validation
