#pragma once

#include <vector>

#include "benchmark/error_table.h"
#include "benchmark/rod_case.h"
#include "benchmark/rod_engine.h"

namespace spring_workbench::benchmark {

/// What the table of rod cases covers.
struct RodTablePlan {
  std::vector<RodCase> cases;
  std::vector<int> steps_per_output;  ///< largest steps of 0.02 s divided by these; a step also ends at every sample
  std::vector<double> tolerances;     ///< [m]; for integrators that choose their steps
  std::vector<double> baseline_tolerances;  ///< for general methods
  double longest_run = 0.025;               ///< see ErrorTablePlan [s per simulated second]
  double longest_coarse_run = 0.025;        ///< the same for runs that are compared, with errors above 1e-3 of the
                                            ///< largest deflection [s per simulated second]
  double longest_engine_run = 0.025;        ///< that of engines
  double tolerance_time_limit = 1.0;        ///< a longer run to a tolerance is given up, and so are finer ones [s]
  Repetition repetition;
};

/// The synthetic cases, and the recorded ones if they are in `recorded_folder`.
RodTablePlan rod_table_plan(bool quick, const std::string& recorded_folder);

/// Number of units of progress, and the rows of all: every integrator × shape × step of every case, with hand()
/// "samples"; with the default shape general methods beside them and, if no degree of freedom is off
/// (RodForce::can_push), engines. The units of work of a case and shape, its reference, its rows and their run times
/// once more, are one shard's, and its methods take turns, as in error_table().
std::size_t unit_count(const RodTablePlan& plan);
std::vector<ErrorRow> rod_table(const RodTablePlan& plan, const std::vector<RodEngine>& engines, Units& units);

/// The error that a tolerance refers to, from position and angle times the body's radius of gyration [m].
double error_as_length(const RodCase& one, double position, double angle);

}  // namespace spring_workbench::benchmark
