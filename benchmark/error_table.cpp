#include "benchmark/error_table.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <ostream>

namespace spring_workbench::benchmark {

ErrorTablePlan error_table_plan(bool quick) {
  ErrorTablePlan plan;
  const std::vector<double> springs = quick ? std::vector<double>{1e4, 1e8} : std::vector<double>{1e2, 1e4, 1e6, 1e8};
  const std::vector<double> twists = quick ? std::vector<double>{1e4} : std::vector<double>{1.0, 1e2, 1e4, 1e6};
  const std::vector<double> factors =
      quick ? std::vector<double>{1.0, 100.0} : std::vector<double>{1.0, 100.0, 1e4, 1e6};
  for (const double k : springs) plan.scenes.push_back(stretch_scene(k));
  for (const double k : twists) plan.scenes.push_back(torsion_scene(k));
  for (const double factor : factors) plan.scenes.push_back(six_dof_scene(factor));
  if (quick) {
    plan.steps_per_output = {1, 4, 16, 64};
    plan.tolerances = {1e-4, 1e-6, 1e-8, 1e-10};
    plan.own_solution_steps = 64;
  } else {
    for (int n = 1; n <= 4096; n *= 2) plan.steps_per_output.push_back(n);
    plan.tolerances = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11};
    plan.own_solution_steps = 512;
    plan.repeats = 5;
    plan.time_limit = 20.0;
  }
  return plan;
}

namespace {

/// Runs with steps halved twice; false when one of them is not finite.
bool run_three(const Method& method, const Scenario& scene, int steps, double time_limit,
               std::array<RunResult, 3>& runs) {
  double step = scene.output_interval / steps;
  for (RunResult& run : runs) {
    run = run_isolated(method, scene, step, 1, time_limit);
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
  const RunResult run = run_isolated(method, scene, setting, plan.repeats, plan.time_limit);
  ErrorRow row;
  row.scene = scene.name;
  row.stiffness_factor = scene.stiffness_factor;
  row.method = method.name();
  (method.knob() == Method::Knob::step ? row.step : row.tolerance) = setting;
  row.reference_uncertainty = reference.uncertainty;
  row.finite = run.finite && !reference.outputs.empty();
  if (!row.finite) return row;
  row.error = output_error(scene, reference, run.outputs);
  row.error_over_hand_amplitude = row.error / hand_amplitude(scene);
  row.error_over_largest_deflection = row.error / reference.largest_deflection;
  row.wall_us_per_simulated_second = 1e6 * run.wall_seconds / scene.duration;
  return row;
}

}  // namespace

std::vector<ErrorRow> error_rows(const Method& method, const Scenario& scene, const ReferenceSolution& reference,
                                 const ErrorTablePlan& plan) {
  std::vector<double> settings = plan.tolerances;
  if (method.knob() == Method::Knob::step) {
    settings.clear();
    for (const int n : plan.steps_per_output) settings.push_back(scene.output_interval / n);
  }
  const bool own = !method.has_scene_law(scene);
  const ReferenceSolution measured_against =
      own ? own_solution(method, scene, plan.own_solution_steps, plan.time_limit) : reference;
  std::vector<ErrorRow> rows;
  for (const double setting : settings) {
    rows.push_back(error_row(method, scene, measured_against, setting, plan));
    rows.back().own_reference = own;
    if (1e-6 * rows.back().wall_us_per_simulated_second * scene.duration > plan.longest_run) break;
  }
  return rows;
}

void write_header(std::ostream& out) {
  out << "scene,stiffness_factor,method,step,tolerance,own_reference,reference_uncertainty,error_abs,"
         "error_over_hand_amplitude,error_over_largest_deflection,wall_us_per_simulated_second,finite\n";
}

void write_row(const ErrorRow& row, std::ostream& out) {
  out << std::setprecision(6) << row.scene << ',' << row.stiffness_factor << ',' << row.method << ',';
  if (row.step > 0.0) out << row.step;
  out << ',';
  if (row.tolerance > 0.0) out << row.tolerance;
  out << ',' << row.own_reference << ',' << row.reference_uncertainty << ',';
  if (row.finite) {
    out << row.error << ',' << row.error_over_hand_amplitude << ',' << row.error_over_largest_deflection << ','
        << row.wall_us_per_simulated_second;
  } else {
    out << ",,,";
  }
  out << ',' << row.finite << '\n';
}

std::vector<ErrorRow> write_error_table(const std::vector<const Method*>& methods, const ErrorTablePlan& plan,
                                        std::ostream& out, std::ostream& progress) {
  write_header(out);
  std::vector<ErrorRow> all;
  std::size_t done = 0;
  for (const Scenario& scene : plan.scenes) {
    const ReferenceSolution reference = reference_solution(scene);
    for (const Method* method : methods) {
      progress << '[' << ++done << '/' << plan.scenes.size() * methods.size() << "] " << scene.name << " × "
               << scene.stiffness_factor << ' ' << method->name() << std::endl;
      for (const ErrorRow& row : error_rows(*method, scene, reference, plan)) {
        write_row(row, out);
        all.push_back(row);
      }
      out.flush();
    }
  }
  return all;
}

}  // namespace spring_workbench::benchmark
