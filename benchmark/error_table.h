#pragma once

#include <iosfwd>
#include <vector>

#include "benchmark/method.h"
#include "benchmark/reference_solution.h"

namespace spring_workbench::benchmark {

/// What an error table covers.
struct ErrorTablePlan {
  std::vector<Scenario> scenes;
  std::vector<int> steps_per_output;  ///< methods with a step take output_interval divided by these
  std::vector<double> tolerances;     ///< methods with a tolerance
  int own_solution_steps = 0;         ///< steps per output of the coarsest of the three runs of own_solution()
  double longest_run = 0.5;           ///< settings beyond the first that takes longer are left out [s]
  int repeats = 1;                    ///< runs of which the fastest counts
  double time_limit = 60.0;           ///< of a run [s]
};

/// The plan for the report: all stiffnesses and steps, or a few of them.
ErrorTablePlan error_table_plan(bool quick);

/// A line of the table.
struct ErrorRow {
  std::string scene;
  double stiffness_factor = 0.0;
  std::string method;
  double step = 0.0;                   ///< [s]; 0 for a method with a tolerance
  double tolerance = 0.0;              ///< 0 for a method with a step
  bool own_reference = false;          ///< measured against the method's own solution
  double reference_uncertainty = 0.0;  ///< [m or rad]
  double error = 0.0;                  ///< largest after scene.settled_after [m or rad]
  double error_over_hand_amplitude = 0.0;
  double error_over_largest_deflection = 0.0;
  double wall_us_per_simulated_second = 0.0;
  bool finite = false;
};

/// The limit to which a method converges: three runs with steps halved twice from `output_interval / steps`, by
/// Richardson's extrapolation of the terms in h and h². Its uncertainty is the last correction of that. Where a run is
/// not finite, all three are made with smaller steps, down to an eighth; empty outputs when that is not enough.
ReferenceSolution own_solution(const Method& method, const Scenario& scene, int steps, double time_limit);

/// Rows of one method on one scene; `reference` is that of the scene.
std::vector<ErrorRow> error_rows(const Method& method, const Scenario& scene, const ReferenceSolution& reference,
                                 const ErrorTablePlan& plan);

/// The header line of the CSV, and one row of it.
void write_header(std::ostream& out);
void write_row(const ErrorRow& row, std::ostream& out);

/// Everything, as CSV to `out` as it comes; progress to `progress`. Returns the rows.
std::vector<ErrorRow> write_error_table(const std::vector<const Method*>& methods, const ErrorTablePlan& plan,
                                        std::ostream& out, std::ostream& progress);

}  // namespace spring_workbench::benchmark
