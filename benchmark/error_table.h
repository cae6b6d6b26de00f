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
  std::vector<double>
      outputs_per_step;  ///< methods that can take long steps on a known hand: steps of output_interval times these
  std::vector<int> steps_per_output;  ///< methods with a step: steps of output_interval divided by these
  std::vector<double> tolerances;     ///< methods with a tolerance
  int own_solution_steps = 0;         ///< steps per output of the coarsest of the three runs of own_solution()
  double longest_run = 0.025;         ///< a curve ends with the first run that takes longer [s per simulated second]
  double longest_coarse_run = 0.025;  ///< the same if the hand is sampled and the error still above 1e-3 of the largest
                                      ///< deflection [s per simulated second]
  Repetition repetition;
  double run_limit = 1.0;    ///< limit of a run with its repetitions; it is then given up, and so are finer ones [s]
  double time_limit = 20.0;  ///< limit of a run for own_solution() [s]
};

/// The plan for the report: all stiffnesses and steps, or a few of them.
ErrorTablePlan error_table_plan(bool quick);

/// A row of the table.
struct ErrorRow {
  std::string scene;
  double stiffness_factor = 1.0;
  double mass = 0.0;  ///< [kg]
  std::string shape = "bushing";
  std::string method;
  bool ours = false;
  /// How the hand is given to the methods: as a "function" of time, evaluated whenever they like, or as "samples", the
  /// poses of a tracker with the same interpolated motion for all.
  std::string hand = "function";
  double step = 0.0;                   ///< [s]; 0 for a method with a tolerance
  double tolerance = 0.0;              ///< 0 for a method with a step
  bool own_reference = false;          ///< whether the error is measured against the method's own limit
  double reference_uncertainty = 0.0;  ///< [m or rad]
  double hand_error = 0.0;             ///< see ReferenceSolution [m or rad]
  double largest_deflection = 0.0;     ///< of the reference [m or rad]
  /// The error that is compared: the largest of position_error, error_between and, for rods, angle_error times the
  /// distance of the body's farthest point from its centre of mass [m; in B rad].
  double error = 0.0;
  double position_error = 0.0;  ///< of the centre of mass (in B: of the twist) at the outputs [m or rad]
  double error_between = 0.0;   ///< the same in a run with additional outputs halfway between
  double angle_error = 0.0;     ///< angle error of these runs, for rods only [rad]
  double error_over_hand_amplitude = 0.0;
  double error_over_largest_deflection = 0.0;
  double wall_us_per_simulated_second = 0.0;  ///< a lower bound if the run was given up
  double steps_per_second = 0.0;              ///< taken, per simulated second; 0: not known
  double error_over_tolerance = 0.0;          ///< for rods run to a tolerance: error_as_length() divided by it
  double model_error = 0.0;                   ///< with `own_reference`: error of that limit itself [as error]
  bool finite = false;
  long steps_fallback = 0;     ///< see RunResult
  bool given_up = false;       ///< whether the run exceeded the plan's limit
  double other_wall_us = 0.0;  ///< wall_us_per_simulated_second of the slower round; 0: measured once
};

template <typename Fields>
void each_field(ErrorRow& r, Fields& fields) {
  fields(r.scene, r.stiffness_factor, r.mass, r.shape, r.method, r.ours, r.hand, r.step, r.tolerance, r.own_reference,
         r.reference_uncertainty, r.hand_error, r.largest_deflection, r.error, r.position_error, r.error_between,
         r.angle_error, r.error_over_hand_amplitude, r.error_over_largest_deflection, r.wall_us_per_simulated_second,
         r.steps_per_second, r.error_over_tolerance, r.model_error, r.finite, r.steps_fallback, r.given_up,
         r.other_wall_us);
}

/// Title of a row for tables and checks: scene, stiffness, mass and how the hand is known.
std::string title_of(const ErrorRow& row);

/// The limit to which a method converges, by Richardson extrapolation of the terms in h and h² from three runs with
/// steps `output_interval / steps` and two halvings. Its uncertainty is the last correction. If a run is not finished,
/// all three are repeated with smaller steps, down to an eighth; if that is not enough, the outputs are empty.
ReferenceSolution own_solution(const Method& method, const Scenario& scene, int steps, double time_limit);

/// Whether the row's run time is used in comparisons: for every baseline and for our default integrator.
bool is_compared(const ErrorRow& row);
bool is_compared(const std::string& method, bool ours);

/// Whether the last three of these `rows` that are finite, finest last, have not reduced the error.
bool has_levelled_off(const std::vector<ErrorRow>& rows);

/// Where a line of steps becomes stable, more closely than by doublings: if its last row is of use (finite, with an
/// error below the largest deflection) and the one before is not, nor has an error that order explains (below 100 times
/// that), adds rows between them, made by `row` for a number of steps per output, by bisection until these numbers
/// differ by less than a quarter. The rows stay in the order of their steps.
void find_begin(std::vector<ErrorRow>& rows, double output_interval, const std::function<ErrorRow(int)>& row);

/// Whether a curve with these `rows`, finest last, needs no finer setting: its last run took longer than `longest_run`
/// [s per simulated second], it has reached the uncertainty of its reference, or it has levelled off with the step. A
/// tolerance has no effect as long as one step per sample keeps it, so all of them are run.
bool line_is_over(const std::vector<ErrorRow>& rows, double longest_run);

/// Adds the time of the second round [µs per simulated second] to that of the first.
void add_round(double wall_us, ErrorRow& row);

/// Measures curves in turns: calls each for its next row until it returns false.
void take_turns(const std::vector<std::function<bool()>>& lines);

/// Indices of `rows`, which are grouped by method, in the order in which the methods take turns.
std::vector<std::size_t> in_turns(const std::vector<ErrorRow>& rows);

/// Writes the rows as CSV with a header line.
void write_rows(const std::vector<ErrorRow>& rows, std::ostream& out);
std::string as_csv(const std::vector<ErrorRow>& rows);

/// The rows of all curves, one for each method on each scene, coarsest first, until line_is_over(). A scene is two
/// units of work of the same shard: its rows, and later, after all scenes, a second measurement of the compared run
/// times, of which the smaller ones count. In both, the methods take turns, setting by setting, so that disturbances of
/// the machine affect all of them.
std::size_t unit_count(const ErrorTablePlan& plan);
std::vector<ErrorRow> error_table(const std::vector<const Method*>& methods, const ErrorTablePlan& plan, Units& units);

}  // namespace spring_workbench::benchmark
