#pragma once

#include <string>
#include <vector>

#include "benchmark/method.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// Number of cases in which a method stays finite and bounded.
struct StabilityCount {
  std::string method;
  std::string scene;  ///< "A" or "C"
  int stable = 0;
  int total = 0;
  int stable_at_50_hz = 0;  ///< of those with one step per output
  int total_at_50_hz = 0;
  int with_fallback = 0;  ///< of all cases, those in which our fallback rule took steps
};

template <typename Fields>
void each_field(StabilityCount& c, Fields& fields) {
  fields(c.method, c.scene, c.stable, c.total, c.stable_at_50_hz, c.total_at_50_hz, c.with_fallback);
}

/// Runs scene A (k = 1 … 1e10 N/m) or C (factor 1e-2 … 1e8) for one second with 11 decades of stiffness, 5 masses from
/// 1e-6 to 1e6 kg, steps of 1/50, 1/100, 1/250 and 1/1000 s, ζ = 1.
StabilityCount count_stable(const Method& method, SceneKind kind);

/// The counts of all methods that have a step and know the hand as a function; two units of work each.
std::vector<StabilityCount> stability_table(const std::vector<const Method*>& methods, Units& units);
bool has_stability_counts(const Method& method);

std::string stability_counts_csv(const std::vector<StabilityCount>& counts);

}  // namespace spring_workbench::benchmark
