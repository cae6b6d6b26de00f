#include "benchmark/rod_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "benchmark/child_runs.h"
#include "benchmark/our_methods.h"
#include "benchmark/rod_reference.h"
#include "benchmark/solver_run.h"
#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kOutputInterval = 0.02;

}  // namespace

RodTablePlan rod_table_plan(bool quick, const std::string& recorded_folder) {
  RodTablePlan plan;
  plan.cases = synthetic_cases(quick);
  if (!quick) {
    for (RodCase& one : recorded_cases(recorded_folder)) plan.cases.push_back(one);
  }
  for (int n = 1; n <= (quick ? 16 : 1024); n *= quick ? 4 : 2) plan.steps_per_output.push_back(n);
  plan.tolerances = quick ? std::vector<double>{1e-5} : std::vector<double>{1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  for (int digits = 0; digits <= 12; digits += quick ? 4 : 1)
    plan.baseline_tolerances.push_back(std::pow(10.0, -digits));
  plan.longest_run = quick ? 0.002 : 0.01;
  // Engines are to be fifty times slower than ours, which take up to 1 ms to a thousandth of the deflection.
  plan.longest_coarse_run = quick ? 0.002 : 0.02;
  plan.longest_engine_run = quick ? 0.002 : 0.05;
  plan.tolerance_time_limit = quick ? 0.05 : 1.0;
  plan.repetition = quick ? Repetition{1, 0.001} : Repetition{2, 0.005};
  return plan;
}

double error_as_length(const RodCase& one, double position, double angle) {
  return std::max(position, angle * std::sqrt(0.5 * one.inertia.sum() / one.mass));
}

namespace {

/// results_of_child(), all given up if the child died or took longer than `time_limit` [s] for each function.
std::vector<RodRun> run_in_time(double time_limit, const std::vector<std::function<RodRun()>>& runs) {
  if (auto results = results_of_child(runs, time_limit * static_cast<double>(runs.size()))) return std::move(*results);
  RodRun given_up;
  given_up.given_up = true;
  return std::vector<RodRun>(runs.size(), given_up);
}

std::vector<std::pair<const RodCase*, std::string>> pairs_of(const std::vector<RodCase>& cases) {
  std::vector<std::pair<const RodCase*, std::string>> pairs;
  for (const RodCase& one : cases) {
    for (const std::string& shape : one.shapes) pairs.emplace_back(&one, shape);
  }
  return pairs;
}

/// Extrapolates a first-order method to step zero from two runs, the second with half the step.
std::vector<RigidTransform> extrapolated(const RodRun& coarse, const RodRun& fine) {
  std::vector<RigidTransform> limit = fine.X_WO;
  for (std::size_t i = 0; i < limit.size(); ++i) {
    const RigidTransform &X0 = coarse.X_WO[i], &X1 = fine.X_WO[i];
    limit[i].translation() = 2.0 * X1.translation() - X0.translation();
    limit[i].linear() = X1.linear() * math::exp_so3(math::log_so3(X0.linear().transpose() * X1.linear()));
  }
  return limit;
}

/// The limit of an integrator that does not solve the equation of motion. Its uncertainty is the change by the last
/// halving.
RodReference own_limit(const RodCase& one, const std::string& shape, const std::string& integrator,
                       const RodReference& exact) {
  constexpr int kStepsPerOutput = 32;
  const RodCase halfway = with_halfway_outputs(one);
  RodRun runs[3];
  for (int i = 0; i < 3; ++i)
    runs[i] = run_simulated(halfway, shape, integrator, kOutputInterval / (kStepsPerOutput << i));
  RodReference limit = exact;
  limit.halfway = extrapolated(runs[1], runs[2]);
  limit.X_WO = every_other(limit.halfway);
  limit.uncertainty = largest_distance(limit.halfway, extrapolated(runs[0], runs[1])).position;
  return limit;
}

/// Whether a case and shape is also run with general methods: for the default shape, or for that of a recording.
bool has_baselines(const RodCase& one, const std::string& shape) {
  return shape == validation::name_of(rod::ForkSettings().shape) || !one.recorded.empty();
}

/// Whether the samples of the hand are farther apart than the outputs, so that steps from one to the next are worth
/// while.
bool samples_are_rare(const RodCase& one) {
  const double interval = (one.hand.back().t - one.hand.front().t) / static_cast<double>(one.hand.size() - 1);
  return interval > 1.5 * one.output_interval;
}

/// Measures one of our integrators on a case, first by step and then by tolerance, or a general method or an engine,
/// setting by setting.
class Line {
 public:
  /// `engine`: the one named `method`, or null.
  Line(const RodTablePlan& plan, const RodCase& one, const std::string& shape, const RodReference& exact,
       const std::string& method, bool ours, const RodEngine* engine = nullptr)
      : plan_(plan), case_(one), shape_(shape), method_(method), ours_(ours), engine_(engine) {
    own_ = ours && !solves_the_equation_of_motion(method);
    reference_ = own_ ? own_limit(one, shape, method, exact) : exact;
    model_error_ = largest_distance(reference_.X_WO, exact.X_WO).position;
    const bool by_step = engine != nullptr || takes_step(method);
    if (ours || by_step) {
      for (const int n : plan.steps_per_output) settings_.push_back({kOutputInterval / n, 0.0});
    }
    for (const double tolerance : ours ? plan.tolerances : std::vector<double>{}) settings_.push_back({0.0, tolerance});
    if (ours || by_step) return;
    for (const double tolerance : plan.baseline_tolerances) settings_.push_back({0.0, tolerance});
  }

  /// Measures the next row; returns false if there is none.
  bool advance() {
    if (!rows_.empty() && part_is_over()) {
      const bool by_step = rows_.back().step > 0.0;
      while (next_ < settings_.size() && by_step && settings_[next_].step > 0.0) ++next_;
      if (!by_step) next_ = settings_.size();
    }
    if (next_ == settings_.size()) return false;
    rows_.push_back(row(settings_[next_++]));
    if (has_compared_times())
      find_begin(rows_, kOutputInterval, [&](int n) { return row({kOutputInterval / n, 0.0}); });
    return true;
  }
  const std::vector<ErrorRow>& rows() const { return rows_; }

  /// The run time of a compared row, measured again [µs per simulated second]; infinite if it is not compared.
  double time_again(const ErrorRow& row) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    if (!row.finite || !has_compared_times()) return none;
    const auto once = [&] { return timed({row.step, row.tolerance}, {1, plan_.repetition.seconds}); };
    const RodRun again = run_in_time(plan_.tolerance_time_limit, {once})[0];
    return again.finite ? 1e6 * again.wall_seconds / case_.duration : none;
  }
  /// Whether one run of a row is done before all its repetitions should be, so that a disturbance may hit all of them.
  bool is_short(const ErrorRow& row) const {
    return 1e-6 * row.wall_us_per_simulated_second * case_.duration < plan_.repetition.seconds;
  }

 private:
  struct Setting {
    double step = 0.0, tolerance = 0.0;  ///< one of the two: step [s], or tolerance (ours: [m])
  };

  RodRun run(const RodCase& one, const Setting& setting) const {
    if (engine_ != nullptr) return run_engine(one, shape_, *engine_, setting.step);
    if (!ours_) {
      return run_solver(one, shape_, method_, setting.step > 0.0 ? setting.step : setting.tolerance,
                        samples_are_rare(case_) && gains_from_long_steps(method_) ? StepEnds::samples
                                                                                  : StepEnds::samples_and_outputs);
    }
    const double step = setting.step > 0.0 ? setting.step : kOutputInterval;
    return run_simulated(one, shape_, method_, step, setting.tolerance);
  }
  bool is_ours_to_tolerance(const Setting& setting) const { return ours_ && setting.tolerance > 0.0; }
  /// Whether run times on this line are compared with those of other methods, or of steps with those to a tolerance.
  bool has_compared_times() const { return is_compared(method_, ours_); }
  RodRun timed(const Setting& setting, Repetition repetition) const {
    if (!has_compared_times()) repetition.runs = 1;
    return fastest(repetition, [&] { return run(case_, setting); });
  }

  /// Whether no finer step or tolerance is needed.
  bool part_is_over() const {
    const ErrorRow& last = rows_.back();
    if (last.error_over_tolerance > 0.0) return 1e-6 * last.wall_us_per_simulated_second > plan_.longest_run;
    const bool is_coarse = has_compared_times() && last.error_over_largest_deflection > 1e-3;
    const double longest_coarse_run = engine_ != nullptr ? plan_.longest_engine_run : plan_.longest_coarse_run;
    return last.given_up || line_is_over(rows_, is_coarse ? longest_coarse_run : plan_.longest_run);
  }

  ErrorRow row(const Setting& setting) const {
    // A tolerance of ours refers to the error at the outputs.
    const bool has_between = !is_ours_to_tolerance(setting);
    std::vector<std::function<RodRun()>> to_run;
    if (has_between) to_run.emplace_back([&] { return run(with_halfway_outputs(case_), setting); });
    const Repetition repetition{plan_.repetition.runs, plan_.repetition.seconds, has_between};
    to_run.emplace_back([&] { return timed(setting, repetition); });
    const std::vector<RodRun> runs = run_in_time(plan_.tolerance_time_limit, to_run);
    const RodRun& run = runs.back();
    ErrorRow r;
    r.scene = case_.name;
    r.shape = shape_;
    r.stiffness_factor = case_.stiffness_factor;
    r.mass = case_.mass;
    r.method = method_;
    r.ours = ours_;
    r.hand = "samples";
    r.step = setting.step;
    r.tolerance = setting.tolerance;
    r.own_reference = own_;
    r.model_error = model_error_;
    r.reference_uncertainty = reference_.uncertainty;
    r.hand_error = reference_.hand_error;
    r.finite = run.finite;
    r.given_up = run.given_up;
    if (run.given_up) r.wall_us_per_simulated_second = 1e6 * plan_.tolerance_time_limit / case_.duration;
    if (!run.finite) return r;
    const PoseDistance at = largest_distance(run.X_WO, reference_.X_WO);
    const PoseDistance between = has_between ? largest_distance(runs.front().X_WO, reference_.halfway) : PoseDistance{};
    r.position_error = at.position;
    r.error_between = between.position;
    r.angle_error = std::max(at.angle, between.angle);
    r.error = std::max({at.position, between.position, r.angle_error * farthest_point(case_)});
    r.largest_deflection = reference_.largest_deflection;
    r.error_over_hand_amplitude = r.error / hand_amplitude(case_);
    r.error_over_largest_deflection = r.error / reference_.largest_deflection;
    r.wall_us_per_simulated_second = 1e6 * run.wall_seconds / case_.duration;
    r.steps_fallback = run.steps_fallback;
    r.steps_per_second = static_cast<double>(run.steps) / case_.duration;
    if (is_ours_to_tolerance(setting))
      r.error_over_tolerance = error_as_length(case_, r.position_error, at.angle) / setting.tolerance;
    return r;
  }

  const RodTablePlan& plan_;
  const RodCase& case_;
  const std::string& shape_;
  std::string method_;
  bool ours_;
  const RodEngine* engine_;
  RodReference reference_;    ///< the reference for errors
  bool own_ = false;          ///< whether that is the method's own limit
  double model_error_ = 0.0;  ///< distance of that limit from the exact solution [m]
  std::vector<Setting> settings_;
  std::size_t next_ = 0;
  std::vector<ErrorRow> rows_;
};

}  // namespace

std::size_t unit_count(const RodTablePlan& plan) { return 2 * pairs_of(plan.cases).size(); }

namespace {

/// The curves of all methods for a case and shape.
std::vector<Line> lines_of(const RodTablePlan& plan, const std::vector<RodEngine>& engines, const RodCase& one,
                           const std::string& shape) {
  const RodReference reference = rod_reference(one, shape);
  std::vector<Line> lines;
  for (const std::string& integrator : validation::names<dynamics::IntegratorKind>())
    lines.emplace_back(plan, one, shape, reference, integrator, true);
  if (!has_baselines(one, shape)) return lines;
  for (const std::string& solver : solver_names()) lines.emplace_back(plan, one, shape, reference, solver, false);
  if (!RodForce::can_push(one, shape)) return lines;
  for (const RodEngine& engine : engines) lines.emplace_back(plan, one, shape, reference, engine.name, false, &engine);
  return lines;
}

std::vector<ErrorRow> rows_of(std::vector<Line>& lines) {
  std::vector<std::function<bool()>> turns;
  for (Line& line : lines) turns.emplace_back([&line] { return line.advance(); });
  take_turns(turns);
  std::vector<ErrorRow> rows;
  for (const Line& line : lines) rows.insert(rows.end(), line.rows().begin(), line.rows().end());
  return rows;
}

/// The second round of run times; short runs are timed twice in it, with all others between.
std::vector<ErrorRow> timed_again(const std::vector<Line>& lines, std::vector<ErrorRow> rows) {
  std::map<std::string, const Line*> line_of;
  for (const Line& line : lines) line_of[line.rows().front().method] = &line;
  std::vector<double> again(rows.size(), std::numeric_limits<double>::infinity());
  for (const bool short_ones : {false, true}) {
    for (const std::size_t i : in_turns(rows)) {
      const Line& line = *line_of.at(rows[i].method);
      if (!short_ones || line.is_short(rows[i])) again[i] = std::min(again[i], line.time_again(rows[i]));
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::isfinite(again[i])) add_round(again[i], rows[i]);
  }
  return rows;
}

}  // namespace

std::vector<ErrorRow> rod_table(const RodTablePlan& plan, const std::vector<RodEngine>& engines, Units& units) {
  units.begin("rods");
  const auto pairs = pairs_of(plan.cases);
  std::vector<std::vector<Line>> lines(pairs.size());
  std::vector<std::vector<ErrorRow>> first(pairs.size());
  const auto name = [&](std::size_t i) { return pairs[i].first->name + ' ' + pairs[i].second; };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    first[i] = units.rows<ErrorRow>(i, name(i), [&, i] {
      lines[i] = lines_of(plan, engines, *pairs[i].first, pairs[i].second);
      return rows_of(lines[i]);
    });
  }
  std::vector<ErrorRow> all;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto rows =
        units.rows<ErrorRow>(i, name(i) + ", timed again", [&, i] { return timed_again(lines[i], first[i]); });
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

}  // namespace spring_workbench::benchmark
