#include "benchmark/error_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

std::vector<Scenario> scenes_of(bool quick) {
  const std::vector<double> springs = quick ? std::vector<double>{1e4} : std::vector<double>{1e2, 1e4, 1e6, 1e8};
  const std::vector<double> twists = quick ? std::vector<double>{1e4} : std::vector<double>{1.0, 1e2, 1e4, 1e6};
  const std::vector<double> factors = quick ? std::vector<double>{1.0} : std::vector<double>{1.0, 100.0, 1e4, 1e6};
  std::vector<Scenario> known, sampled;
  for (const double k : springs) known.push_back(stretch_scene(k));
  for (const double k : twists) known.push_back(torsion_scene(k));
  for (const double factor : factors) {
    if (!quick || factor == 1.0) known.push_back(six_dof_scene(factor));  // the others on samples only
  }
  // The practical case: poses of a tracker; soft and stiff, light and heavy.
  for (const double factor : factors) sampled.push_back(six_dof_scene(factor));
  if (!quick) {
    // A tonne on the soft fork would hang metres below the hand, wound up; one on × 1e6 moves as a gram on × 1.
    for (const auto& [factor, mass] : {std::pair{1.0, 1e-3}, {1e6, 1e-3}, {1e4, 1e3}, {1e5, 1e3}}) {
      sampled.push_back(six_dof_scene(factor, 1.0, mass));
    }
    for (const double k : {1e4, 1e6}) sampled.push_back(stretch_scene(k));
    for (const double k : {1e4, 1e6}) sampled.push_back(torsion_scene(k));
  }
  if (quick) {
    for (std::vector<Scenario>* scenes : {&known, &sampled}) {
      for (Scenario& scene : *scenes) scene.duration = 2.0;
    }
  }
  for (const Scenario& scene : sampled) known.push_back(with_sampled_hand(scene));
  return known;
}

}  // namespace

ErrorTablePlan error_table_plan(bool quick) {
  ErrorTablePlan plan;
  plan.scenes = scenes_of(quick);
  plan.outputs_per_step = quick ? std::vector<double>{4} : std::vector<double>{16, 8, 4, 2};
  for (int n = 1; n <= 8192; n *= quick ? 4 : 2) plan.steps_per_output.push_back(n);
  for (int digits = 0; digits <= 12; digits += quick ? 4 : 1) plan.tolerances.push_back(std::pow(10.0, -digits));
  plan.own_solution_steps = quick ? 32 : 64;
  plan.longest_run = quick ? 0.002 : 0.01;
  // Engines are to be fifty times slower than ours, which take 0.4 ms to a thousandth of the deflection.
  plan.longest_coarse_run = quick ? 0.002 : 0.02;
  plan.repetition = quick ? Repetition{1, 0.001} : Repetition{2, 0.005};
  return plan;
}

namespace {

/// Makes three runs with steps halved twice; returns false if one of them is not finite.
bool run_three(const Method& method, const Scenario& scene, int steps, double time_limit,
               std::array<RunResult, 3>& runs) {
  double step = scene.output_interval / steps;
  for (RunResult& run : runs) {
    run = run_isolated(method, scene, step, {}, time_limit);
    if (!run.finite) return false;
    step *= 0.5;
  }
  return true;
}

}  // namespace

ReferenceSolution own_solution(const Method& method, const Scenario& scene, int steps, double time_limit) {
  std::array<RunResult, 3> runs;
  const int smallest = 8 * steps;
  while (!run_three(method, scene, steps, time_limit, runs)) {
    steps *= 2;
    if (steps > smallest) return {};
  }
  std::vector<Vector3d> limit, without_square;
  for (std::size_t i = 0; i < runs[0].outputs.size(); ++i) {
    const Vector3d coarse = 2.0 * runs[1].outputs[i] - runs[0].outputs[i];
    const Vector3d fine = 2.0 * runs[2].outputs[i] - runs[1].outputs[i];
    without_square.push_back(fine);
    limit.push_back((4.0 * fine - coarse) / 3.0);
  }
  ReferenceSolution reference = reference_from_outputs(scene, std::move(limit), 0.0);
  reference.uncertainty = output_error(scene, reference, without_square);
  return reference;
}

namespace {

/// The scene with additional outputs halfway between its own.
Scenario with_halfway_outputs(Scenario scene) {
  scene.output_interval *= 0.5;
  return scene;
}

/// Every other output, i.e. those of the scene itself.
ReferenceSolution at_own_outputs(ReferenceSolution reference) {
  for (std::size_t i = 0; 2 * i < reference.outputs.size(); ++i) reference.outputs[i] = reference.outputs[2 * i];
  reference.outputs.resize((reference.outputs.size() + 1) / 2);
  return reference;
}

/// A method on a scene, setting by setting.
class Line {
 public:
  /// `reference` is that of the scene with_halfway_outputs().
  Line(const Method& method, const Scenario& scene, const ReferenceSolution& reference, const ErrorTablePlan& plan)
      : method_(method), scene_(scene), halfway_(with_halfway_outputs(scene)), plan_(plan), between_(reference) {
    own_ = !method.has_scene_law(scene);
    if (own_) {
      // Steps of Simulation cost several of an engine's.
      const int steps = method.ours() ? plan.own_solution_steps / 4 : plan.own_solution_steps;
      between_ = own_solution(method, halfway_, steps, plan.time_limit);
      between_.hand_error = reference.hand_error;
      const bool comparable = !between_.outputs.empty() && !reference.outputs.empty();
      if (comparable) model_error_ = output_error(halfway_, reference, between_.outputs);
    }
    reference_ = at_own_outputs(between_);
    if (method.knob() == Method::Knob::tolerance) {
      settings_ = plan.tolerances;
      return;
    }
    for (const double n : plan.outputs_per_step) {
      if (method.takes_long_steps() && !scene.samples) settings_.push_back(scene.output_interval * n);
    }
    for (const int n : plan.steps_per_output) settings_.push_back(scene.output_interval / n);
  }

  /// Measures the next row; returns false if there is none.
  bool advance() {
    if (next_ == settings_.size()) return false;
    if (!rows_.empty()) {
      const bool is_coarse = scene_.samples && rows_.back().error_over_largest_deflection > 1e-3;
      const double longest = is_coarse ? plan_.longest_coarse_run : plan_.longest_run;
      if (rows_.back().given_up || line_is_over(rows_, longest)) return false;
    }
    rows_.push_back(row(settings_[next_++]));
    if (is_compared(rows_.back()))
      find_begin(rows_, scene_.output_interval, [&](int n) { return row(scene_.output_interval / n); });
    return true;
  }
  const std::vector<ErrorRow>& rows() const { return rows_; }

 private:
  ErrorRow row(double setting) const {
    const bool compared = is_compared(method_.name(), method_.ours());
    const Repetition repetition{compared ? plan_.repetition.runs : 1, plan_.repetition.seconds, true};
    const std::vector<RunResult> runs =
        run_isolated({[&] { return method_.run(halfway_, setting_between(setting)); },
                      [&] { return fastest(repetition, [&] { return method_.run(scene_, setting); }); }},
                     plan_.run_limit);
    const RunResult &between = runs[0], &run = runs[1];
    ErrorRow row;
    row.scene = scene_.name;
    row.stiffness_factor = scene_.stiffness_factor;
    row.method = method_.name();
    row.ours = method_.ours();
    row.mass = scene_.mass;
    row.hand = scene_.samples ? "samples" : "function";
    row.own_reference = own_;
    row.model_error = model_error_;
    if (method_.knob() == Method::Knob::step) {
      row.step = setting;
      row.steps_per_second = 1.0 / step_length(scene_, setting);
    } else {
      row.tolerance = setting;
    }
    row.reference_uncertainty = reference_.uncertainty;
    row.hand_error = reference_.hand_error;
    row.largest_deflection = reference_.largest_deflection;
    row.steps_fallback = run.steps_fallback;
    row.given_up = run.given_up;
    if (run.given_up) row.wall_us_per_simulated_second = 1e6 * plan_.run_limit / scene_.duration;
    if (!run.finite || reference_.outputs.empty()) return row;
    row.finite = true;
    row.position_error = output_error(scene_, reference_, run.outputs);
    row.error_between = output_error(halfway_, between_, between.outputs);
    row.error = std::max(row.position_error, row.error_between);
    row.error_over_hand_amplitude = row.error / hand_amplitude(scene_);
    row.error_over_largest_deflection = row.error / reference_.largest_deflection;
    row.wall_us_per_simulated_second = 1e6 * run.wall_seconds / scene_.duration;
    return row;
  }

  /// That of an untimed run with additional outputs halfway between: its steps end there, too, unless they may be
  /// longer.
  double setting_between(double setting) const {
    const bool is_long = setting > 1.000001 * scene_.output_interval || method_.knob() == Method::Knob::tolerance;
    return is_long ? setting : std::min(setting, halfway_.output_interval);
  }

  const Method& method_;
  const Scenario& scene_;
  Scenario halfway_;
  const ErrorTablePlan& plan_;
  ReferenceSolution between_, reference_;  ///< with halfway outputs; at the outputs
  bool own_ = false;                       ///< whether it is measured against its own limit
  double model_error_ = 0.0;
  std::vector<double> settings_;
  std::size_t next_ = 0;  ///< of settings_
  std::vector<ErrorRow> rows_;
};

}  // namespace

std::string title_of(const ErrorRow& row) {
  std::ostringstream title;
  title << row.scene << " × " << row.stiffness_factor << ", " << row.mass << " kg, hand by " << row.hand;
  return title.str();
}

namespace {

std::string scene_title(const Scenario& scene) {
  ErrorRow row;
  row.scene = scene.name;
  row.stiffness_factor = scene.stiffness_factor;
  row.mass = scene.mass;
  row.hand = scene.samples ? "samples" : "function";
  return title_of(row);
}

}  // namespace

bool is_compared(const std::string& method, bool ours) {
  return !ours || method == validation::name_of(dynamics::DynamicsSettings().integrator);
}

bool is_compared(const ErrorRow& row) { return is_compared(row.method, row.ours); }

bool has_levelled_off(const std::vector<ErrorRow>& rows) {
  double best = std::numeric_limits<double>::infinity();
  int without_gain = 0;
  for (const ErrorRow& row : rows) {
    if (!row.finite) continue;
    without_gain = row.error < 0.8 * best ? 0 : without_gain + 1;
    best = std::min(best, row.error);
  }
  return without_gain >= 3;
}

void find_begin(std::vector<ErrorRow>& rows, double output_interval, const std::function<ErrorRow(int)>& row) {
  const auto is_of_use = [](const ErrorRow& r) { return r.finite && r.error_over_largest_deflection < 1.0; };
  const auto steps_of = [&](const ErrorRow& r) { return static_cast<int>(std::lround(output_interval / r.step)); };
  if (rows.size() < 2 || rows.back().step == 0.0) return;
  const std::size_t last = rows.size() - 1;
  const ErrorRow &before = rows[last - 1], &first = rows[last];
  if (is_of_use(before) || !is_of_use(first) || (before.finite && before.error < 100.0 * first.error)) return;
  int fails = steps_of(rows[last - 1]), works = steps_of(rows[last]);
  while (fails > 0 && 4 * works > 5 * fails && works - fails > 1) {
    const int middle = (fails + works) / 2;
    rows.push_back(row(middle));
    (is_of_use(rows.back()) ? works : fails) = middle;
  }
  std::sort(rows.begin() + static_cast<std::ptrdiff_t>(last), rows.end(),
            [](const ErrorRow& a, const ErrorRow& b) { return a.step > b.step; });
}

bool line_is_over(const std::vector<ErrorRow>& rows, double longest_run) {
  const ErrorRow& last = rows.back();
  if (!last.finite) return false;
  if (1e-6 * last.wall_us_per_simulated_second > longest_run || last.error <= 2.0 * last.reference_uncertainty) {
    return true;
  }
  return last.tolerance == 0.0 && has_levelled_off(rows) && last.error_over_hand_amplitude < 1e-2;
}

void add_round(double wall_us, ErrorRow& row) {
  double& least = row.wall_us_per_simulated_second;
  row.other_wall_us = std::max(least, wall_us);
  least = std::min(least, wall_us);
}

void take_turns(const std::vector<std::function<bool()>>& lines) {
  std::vector<bool> over(lines.size());
  while (std::find(over.begin(), over.end(), false) != over.end()) {
    for (std::size_t i = 0; i < lines.size(); ++i) over[i] = over[i] || !lines[i]();
  }
}

std::vector<std::size_t> in_turns(const std::vector<ErrorRow>& rows) {
  std::vector<std::pair<std::size_t, std::size_t>> order;  // position in its curve, index
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool same = i > 0 && rows[i - 1].method == rows[i].method;
    order.emplace_back(same ? order.back().first + 1 : 0, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> numbers;
  for (const auto& [place, number] : order) numbers.push_back(number);
  return numbers;
}

std::size_t unit_count(const ErrorTablePlan& plan) { return 2 * plan.scenes.size(); }

namespace {

/// Rows of every method on one scene.
std::vector<ErrorRow> scene_rows(const std::vector<const Method*>& methods, const Scenario& scene,
                                 const ErrorTablePlan& plan) {
  const ReferenceSolution reference = reference_solution(with_halfway_outputs(scene));
  std::vector<Line> lines;
  lines.reserve(methods.size());
  std::vector<std::function<bool()>> turns;
  for (const Method* method : methods) {
    if (!method->runs_on(scene)) continue;
    lines.emplace_back(*method, scene, reference, plan);
    turns.emplace_back([&line = lines.back()] { return line.advance(); });
  }
  take_turns(turns);
  std::vector<ErrorRow> rows;
  for (const Line& line : lines) rows.insert(rows.end(), line.rows().begin(), line.rows().end());
  return rows;
}

/// The rows of one scene with the run times of a second measurement if these are smaller.
std::vector<ErrorRow> timed_again(const std::vector<const Method*>& methods, const Scenario& scene,
                                  std::vector<ErrorRow> rows, const ErrorTablePlan& plan) {
  for (const std::size_t i : in_turns(rows)) {
    ErrorRow& row = rows[i];
    if (!row.finite || !is_compared(row)) continue;
    const auto same = [&](const Method* method) { return method->name() == row.method; };
    const Method& method = **std::find_if(methods.begin(), methods.end(), same);
    const double setting = method.knob() == Method::Knob::step ? row.step : row.tolerance;
    const RunResult run = run_isolated(method, scene, setting, {1, plan.repetition.seconds}, plan.run_limit);
    if (run.finite) add_round(1e6 * run.wall_seconds / scene.duration, row);
  }
  return rows;
}

}  // namespace

std::vector<ErrorRow> error_table(const std::vector<const Method*>& methods, const ErrorTablePlan& plan, Units& units) {
  units.begin("scenes");
  std::vector<std::vector<ErrorRow>> first;
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    const Scenario& scene = plan.scenes[i];
    first.push_back(units.rows<ErrorRow>(i, scene_title(scene), [&] { return scene_rows(methods, scene, plan); }));
  }
  std::vector<ErrorRow> all;
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    const Scenario& scene = plan.scenes[i];
    const auto rows = units.rows<ErrorRow>(i, scene_title(scene) + ", timed again",
                                           [&] { return timed_again(methods, scene, first[i], plan); });
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

}  // namespace spring_workbench::benchmark
