#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace spring_workbench::validation {

/// What a child process may use.
struct ChildLimits {
  double time = 0.0;  ///< of the processor; ten times as much of the wall [s]
  std::uint64_t memory = std::numeric_limits<std::uint64_t>::max();  ///< beyond what the caller has [bytes]
};

/// What `work` returns, from a child process whose output goes nowhere: what aborts, hangs, eats memory or runs wild
/// there does not take the caller along. Nothing where the child died, `work` threw, or it hit a limit. The child has
/// the calling thread alone: `work` must not wait for others. Throws InputError where no process can be made.
std::optional<std::string> run_in_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace spring_workbench::validation
