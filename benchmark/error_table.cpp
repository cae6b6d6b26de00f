#include "benchmark/error_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

std::vector<Scenario> scenes_of(bool quick) {
  const std::vector<double> springs = quick ? std::vector<double>{1e4} : std::vector<double>{1e2, 1e4, 1e6, 1e8};
  const std::vector<double> twists = quick ? std::vector<double>{1e4} : std::vector<double>{1.0, 1e2, 1e4, 1e6};
  const std::vector<double> factors =
      quick ? std::vector<double>{1.0, 100.0} : std::vector<double>{1.0, 100.0, 1e4, 1e6};
  std::vector<Scenario> known, sampled;
  for (const double k : springs) known.push_back(stretch_scene(k));
  for (const double k : twists) known.push_back(torsion_scene(k));
  for (const double factor : factors) known.push_back(six_dof_scene(factor));
  // What a user has: a tracker's poses; soft and stiff, light and heavy.
  for (const double factor : factors) sampled.push_back(six_dof_scene(factor));
  if (!quick) {
    // A tonne on the soft fork would hang metres below the hand, turned round and round.
    for (const auto& [factor, mass] : {std::pair{1.0, 1e-3}, {1e6, 1e-3}, {1e4, 1e3}, {1e6, 1e3}}) {
      sampled.push_back(six_dof_scene(factor, 1.0, mass));
    }
    sampled.push_back(stretch_scene(1e4));
    sampled.push_back(torsion_scene(1e4));
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
  for (int digits = 0; digits <= 12; digits += quick ? 3 : 1) plan.tolerances.push_back(std::pow(10.0, -digits));
  plan.own_solution_steps = quick ? 32 : 128;
  plan.longest_run = quick ? 0.002 : 0.01;
  plan.repetition = quick ? Repetition{1, 0.0025} : Repetition{2, 0.01};
  return plan;
}

namespace {

/// Runs with steps halved twice; false when one of them is not finite.
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

ErrorRow error_row(const Method& method, const Scenario& scene, const ReferenceSolution& reference, double setting,
                   const ErrorTablePlan& plan) {
  const RunResult run = run_isolated(method, scene, setting, plan.repetition, plan.run_limit);
  ErrorRow row;
  row.scene = scene.name;
  row.stiffness_factor = scene.stiffness_factor;
  row.method = method.name();
  row.ours = method.ours();
  row.mass = scene.mass;
  row.hand = scene.samples ? "samples" : "function";
  if (method.knob() == Method::Knob::step) {
    row.step = setting;
    row.steps_per_second = 1.0 / step_length(scene, setting);
  } else {
    row.tolerance = setting;
  }
  row.reference_uncertainty = reference.uncertainty;
  row.hand_error = reference.hand_error;
  row.largest_deflection = reference.largest_deflection;
  row.steps_fallback = run.steps_fallback;
  row.given_up = run.given_up;
  if (run.given_up) row.wall_us_per_simulated_second = 1e6 * plan.run_limit / scene.duration;
  row.finite = run.finite && !reference.outputs.empty();
  if (!row.finite) return row;
  row.error = output_error(scene, reference, run.outputs);
  row.error_over_hand_amplitude = row.error / hand_amplitude(scene);
  row.error_over_largest_deflection = row.error / reference.largest_deflection;
  row.wall_us_per_simulated_second = 1e6 * run.wall_seconds / scene.duration;
  return row;
}

}  // namespace

std::string title_of(const ErrorRow& row) {
  std::ostringstream title;
  title << row.scene << " × " << row.stiffness_factor << ", " << row.mass << " kg, hand by " << row.hand;
  return title.str();
}

bool line_is_over(const std::vector<ErrorRow>& rows, double longest_run) {
  const ErrorRow& last = rows.back();
  if (!last.finite) return false;
  if (1e-6 * last.wall_us_per_simulated_second > longest_run || last.error <= 2.0 * last.reference_uncertainty) {
    return true;
  }
  double best = std::numeric_limits<double>::infinity();
  int without_gain = 0;
  for (const ErrorRow& row : rows) {
    if (!row.finite) continue;
    without_gain = row.error < 0.8 * best ? 0 : without_gain + 1;
    best = std::min(best, row.error);
  }
  return without_gain >= 3 && last.error_over_hand_amplitude < 1e-2;
}

std::vector<ErrorRow> error_rows(const Method& method, const Scenario& scene, const ReferenceSolution& reference,
                                 const ErrorTablePlan& plan) {
  std::vector<double> settings = plan.tolerances;
  if (method.knob() == Method::Knob::step) {
    settings.clear();
    for (const double n : plan.outputs_per_step) {
      if (method.takes_long_steps() && !scene.samples) settings.push_back(scene.output_interval * n);
    }
    for (const int n : plan.steps_per_output) settings.push_back(scene.output_interval / n);
  }
  const bool own = !method.has_scene_law(scene);
  ReferenceSolution measured_against =
      own ? own_solution(method, scene, plan.own_solution_steps, plan.time_limit) : reference;
  const bool comparable = own && !measured_against.outputs.empty() && !reference.outputs.empty();
  const double model_error = comparable ? output_error(scene, reference, measured_against.outputs) : 0.0;
  measured_against.hand_error = reference.hand_error;
  std::vector<ErrorRow> rows;
  for (const double setting : settings) {
    rows.push_back(error_row(method, scene, measured_against, setting, plan));
    rows.back().own_reference = own;
    rows.back().model_error = model_error;
    if (rows.back().given_up || line_is_over(rows, plan.longest_run)) break;
  }
  return rows;
}

std::size_t unit_count(const std::vector<const Method*>& methods, const ErrorTablePlan& plan) {
  return 2 * methods.size() * plan.scenes.size();
}

namespace {

/// The finite ones of `rows` with the run time of other runs.
std::vector<ErrorRow> timed_again(const Method& method, const Scenario& scene, std::vector<ErrorRow> rows,
                                  const ErrorTablePlan& plan) {
  for (ErrorRow& row : rows) {
    if (!row.finite) continue;
    const double setting = method.knob() == Method::Knob::step ? row.step : row.tolerance;
    const RunResult run = run_isolated(method, scene, setting, plan.repetition, plan.run_limit);
    row.wall_us_per_simulated_second = 1e6 * run.wall_seconds / scene.duration;
  }
  return rows;
}

}  // namespace

std::vector<ErrorRow> error_table(const std::vector<const Method*>& methods, const ErrorTablePlan& plan, Units& units) {
  struct Line {
    const Scenario* scene;
    const Method* method;
    std::string name;
    std::vector<ErrorRow> rows;
  };
  std::vector<Line> lines;
  for (const Scenario& scene : plan.scenes) {
    std::optional<ReferenceSolution> reference;
    for (const Method* method : methods) {
      std::ostringstream name;
      name << scene.name << " × " << scene.stiffness_factor << ", " << scene.mass << " kg, hand by "
           << (scene.samples ? "samples " : "function ") << method->name();
      const auto measure = [&] {
        if (!reference) reference = reference_solution(scene);
        return error_rows(*method, scene, *reference, plan);
      };
      lines.push_back({&scene, method, name.str(), units.rows<ErrorRow>(lines.size(), name.str(), measure)});
    }
  }
  std::vector<ErrorRow> all;
  for (std::size_t number = 0; number < lines.size(); ++number) {
    Line& line = lines[number];
    const std::string name = line.name + ", timed again";
    const std::vector<ErrorRow> again = units.rows<ErrorRow>(
        number, name, [&line, &plan] { return timed_again(*line.method, *line.scene, line.rows, plan); });
    if (again.size() != line.rows.size()) {
      validation::refuse("shards", "unit", name, "as many rows as the line that it times again");
    }
    for (std::size_t i = 0; i < line.rows.size(); ++i) {
      double& time = line.rows[i].wall_us_per_simulated_second;
      time = std::min(time, again[i].wall_us_per_simulated_second);
      all.push_back(line.rows[i]);
    }
  }
  return all;
}

}  // namespace spring_workbench::benchmark
