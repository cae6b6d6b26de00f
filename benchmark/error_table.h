#pragma once

#include <functional>
#include <iosfwd>
#include <vector>

#include "benchmark/method.h"
#include "benchmark/reference_solution.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// What an error table covers.
struct ErrorTablePlan {
  std::vector<Scenario> scenes;
  std::vector<double> outputs_per_step;  ///< methods that take long steps on a known hand: output_interval times these
  std::vector<int> steps_per_output;     ///< methods with a step take output_interval divided by these
  std::vector<double> tolerances;        ///< methods with a tolerance
  int own_solution_steps = 0;            ///< steps per output of the coarsest of the three runs of own_solution()
  double longest_run = 0.025;            ///< a line ends with the first run that takes longer [s per simulated second]
  Repetition repetition;
  double run_limit = 1.0;    ///< of a run and its repetitions: given up after that, and so are finer ones [s]
  double time_limit = 20.0;  ///< of a run for own_solution() [s]
};

/// The plan for the report: all stiffnesses and steps, or a few of them.
ErrorTablePlan error_table_plan(bool quick);

/// A line of the table.
struct ErrorRow {
  std::string scene;
  double stiffness_factor = 1.0;
  double mass = 0.0;  ///< [kg]
  std::string shape = "bushing";
  std::string method;
  bool ours = false;
  /// What everybody knows of the hand: "function" of time, asked for whenever they like, or "samples": the poses of a
  /// tracker, a motion through which is the same for all.
  std::string hand = "function";
  double step = 0.0;                   ///< [s]; 0 for a method with a tolerance
  double tolerance = 0.0;              ///< 0 for a method with a step
  bool own_reference = false;          ///< measured against the method's own solution
  double reference_uncertainty = 0.0;  ///< [m or rad]
  double hand_error = 0.0;             ///< as of ReferenceSolution [m or rad]
  double largest_deflection = 0.0;     ///< of the reference [m or rad]
  /// What is compared, the largest of: position_error, error_between, and of rods angle_error times the distance of
  /// the body's farthest point from its centre of mass [m; in B rad].
  double error = 0.0;
  double position_error = 0.0;  ///< of the centre of mass, or in B of the twist, at the outputs [m or rad]
  double error_between = 0.0;   ///< the same in a run that is also asked half-way between the outputs
  double angle_error = 0.0;     ///< the same runs' [rad]; of rods alone
  double error_over_hand_amplitude = 0.0;
  double error_over_largest_deflection = 0.0;
  double wall_us_per_simulated_second = 0.0;  ///< of a run that was given up: it takes longer than this
  double steps_per_second = 0.0;              ///< taken, per simulated second; 0: not known
  double error_over_tolerance = 0.0;          ///< of rods run to a tolerance: error_as_length() over it
  double model_error = 0.0;  ///< with `own_reference`: how far that solution is from the exact one [as error]
  bool finite = false;
  long steps_fallback = 0;  ///< as of RunResult
  bool given_up = false;    ///< not finished within the plan's limit for a run
};

template <typename Fields>
void each_field(ErrorRow& r, Fields& fields) {
  fields(r.scene, r.stiffness_factor, r.mass, r.shape, r.method, r.ours, r.hand, r.step, r.tolerance, r.own_reference,
         r.reference_uncertainty, r.hand_error, r.largest_deflection, r.error, r.position_error, r.error_between,
         r.angle_error, r.error_over_hand_amplitude, r.error_over_largest_deflection, r.wall_us_per_simulated_second,
         r.steps_per_second, r.error_over_tolerance, r.model_error, r.finite, r.steps_fallback, r.given_up);
}

/// What a row is about: scene, stiffness, mass and what is known of the hand, for tables and verdicts.
std::string title_of(const ErrorRow& row);

/// The limit to which a method converges: three runs with steps halved twice from `output_interval / steps`, by
/// Richardson's extrapolation of the terms in h and h². Its uncertainty is the last correction of that. Where a run is
/// not finite, all three are made with smaller steps, down to an eighth; empty outputs when that is not enough.
ReferenceSolution own_solution(const Method& method, const Scenario& scene, int steps, double time_limit);

/// Whether its run time stands in a comparison: that of every peer, and of our default integrator.
bool is_compared(const ErrorRow& row);

/// Whether a line that gave `rows` so far, finest last, is worth no finer setting: its last run took longer than
/// `longest_run` [s per simulated second], it is down at the uncertainty of its reference, or three settings in a row
/// have not lowered its error.
bool line_is_over(const std::vector<ErrorRow>& rows, double longest_run);

/// Lets lines take turns: each is asked for its next row until it says that there is none.
void take_turns(const std::vector<std::function<bool()>>& lines);

/// Numbers of `rows`, of which those of a method follow each other, in the order in which the methods take turns.
std::vector<std::size_t> in_turns(const std::vector<ErrorRow>& rows);

/// The rows with a header line, as CSV.
void write_rows(const std::vector<ErrorRow>& rows, std::ostream& out);
std::string as_csv(const std::vector<ErrorRow>& rows);

/// The rows of all lines, a line for each method on each scene, coarsest first, until line_is_over(). A scene is two
/// units of work, both of one shard: its rows, and, when all scenes have been through, the run times that are compared
/// once more, of which the lesser ones count. In both the methods take turns, setting by setting, so that whatever the
/// machine does meets all of them.
std::size_t unit_count(const ErrorTablePlan& plan);
std::vector<ErrorRow> error_table(const std::vector<const Method*>& methods, const ErrorTablePlan& plan, Units& units);

}  // namespace spring_workbench::benchmark
