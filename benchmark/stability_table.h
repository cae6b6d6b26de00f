#pragma once

#include <iosfwd>
#include <vector>

#include "benchmark/method.h"

namespace spring_workbench::benchmark {

/// In how many cases a method stays finite and bounded.
struct StabilityCount {
  int stable = 0;
  int total = 0;
  int stable_at_50_hz = 0;  ///< those with one step per output
  int total_at_50_hz = 0;
};

/// Scene A (k = 1 … 1e10 N/m) or C (factor 1e-2 … 1e8) in 11 decades of stiffness, 5 masses from 1e-6 to 1e6 kg, steps
/// of 1/50, 1/100, 1/250 and 1/1000 s, ζ = 1.
StabilityCount count_stable(const Method& method, SceneKind kind);

/// The counts of all methods that have a step, as CSV.
void write_stability_table(const std::vector<const Method*>& methods, std::ostream& out, std::ostream& progress);

}  // namespace spring_workbench::benchmark
