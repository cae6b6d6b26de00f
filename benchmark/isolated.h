#pragma once

#include <functional>
#include <optional>
#include <string>

namespace spring_workbench::benchmark {

/// What `work` returns, from a child process whose output goes nowhere: what aborts, hangs or runs wild there does not
/// take the report along. Nothing where the child died, `work` threw, or it took longer than `time_limit` [s]. The caller
/// must have no other threads. Throws std::runtime_error where no process can be made.
std::optional<std::string> run_in_child(const std::function<std::string()>& work, double time_limit);

}  // namespace spring_workbench::benchmark
