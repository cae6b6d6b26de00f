#include "benchmark/rod_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "benchmark/our_methods.h"
#include "benchmark/parallel.h"
#include "benchmark/rod_reference.h"
#include "benchmark/solver_run.h"
#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/run_in_child.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kOutputInterval = 0.02;

/// The fastest of some runs.
template <typename Run>
RodRun fastest(const Repetition& repetition, Run&& run) {
  RodRun best = run();
  double spent = best.wall_seconds;
  for (int runs = 1; best.finite && wants_another(repetition, runs, spent); ++runs) {
    const double again = run().wall_seconds;
    spent += again;
    best.wall_seconds = std::min(best.wall_seconds, again);
  }
  return best;
}

}  // namespace

RodTablePlan rod_table_plan(bool quick, const std::string& recorded_folder) {
  RodTablePlan plan;
  plan.cases = synthetic_cases(quick);
  if (!quick) {
    for (RodCase& one : recorded_cases(recorded_folder)) plan.cases.push_back(one);
  }
  for (int n = 1; n <= (quick ? 16 : 1024); n *= quick ? 4 : 2) plan.steps_per_output.push_back(n);
  plan.tolerances = quick ? std::vector<double>{1e-5} : std::vector<double>{1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  for (int digits = 0; digits <= 12; digits += quick ? 4 : 1) plan.peer_tolerances.push_back(std::pow(10.0, -digits));
  plan.longest_run = quick ? 0.005 : 0.01;
  plan.tolerance_time_limit = quick ? 0.1 : 1.0;
  plan.repetition = quick ? Repetition{1, 0.005} : Repetition{2, 0.02};
  return plan;
}

double error_as_length(const RodCase& one, double position, double angle) {
  return std::max(position, angle * std::sqrt(0.5 * one.inertia.sum() / one.mass));
}

namespace {

/// What comes before the poses.
struct Header {
  double wall_seconds;
  long steps, steps_fallback;
  bool finite;
};

using PoseNumbers = Eigen::Matrix<double, 3, 4>;

std::string packed(const RodRun& run) {
  const Header header{run.wall_seconds, run.steps, run.steps_fallback, run.finite};
  std::string data(reinterpret_cast<const char*>(&header), sizeof(header));
  for (const RigidTransform& X : run.X_WO) {
    const PoseNumbers numbers = X.matrix().topRows<3>();
    data.append(reinterpret_cast<const char*>(numbers.data()), sizeof(double) * 12);
  }
  return data;
}

RodRun unpacked(const std::string& data) {
  Header header{};
  std::memcpy(&header, data.data(), sizeof(header));
  RodRun run;
  run.wall_seconds = header.wall_seconds;
  run.steps = header.steps;
  run.steps_fallback = header.steps_fallback;
  run.finite = header.finite;
  for (std::size_t at = sizeof(header); at < data.size(); at += sizeof(double) * 12) {
    PoseNumbers numbers;
    std::memcpy(numbers.data(), data.data() + at, sizeof(double) * 12);
    run.X_WO.push_back(RigidTransform::Identity());
    run.X_WO.back().matrix().topRows<3>() = numbers;
  }
  return run;
}

/// In a child process, given up after `time_limit` [s].
template <typename Run>
RodRun run_in_time(double time_limit, Run&& run) {
  if (const auto data = validation::run_in_child([&] { return packed(run()); }, {time_limit})) return unpacked(*data);
  RodRun given_up;
  given_up.given_up = true;
  return given_up;
}

std::vector<std::pair<const RodCase*, std::string>> pairs_of(const std::vector<RodCase>& cases) {
  std::vector<std::pair<const RodCase*, std::string>> pairs;
  for (const RodCase& one : cases) {
    for (const std::string& shape : one.shapes) pairs.emplace_back(&one, shape);
  }
  return pairs;
}

/// Of every case and shape that is measured here, in their order; on all processors, since nothing is timed.
std::vector<RodReference> rod_references(const std::vector<std::pair<const RodCase*, std::string>>& pairs,
                                         Units& units) {
  std::vector<RodReference> references(pairs.size());
  parallel_for(pairs.size(), [&](std::size_t i) {
    units.progress().next("reference: " + pairs[i].first->name + ' ' + pairs[i].second);
    if (units.measured_here(i)) references[i] = rod_reference(*pairs[i].first, pairs[i].second);
  });
  return references;
}

/// Where a method of order one goes with its step, from two runs, the second with half the step.
std::vector<RigidTransform> extrapolated(const RodRun& coarse, const RodRun& fine) {
  std::vector<RigidTransform> limit = fine.X_WO;
  for (std::size_t i = 0; i < limit.size(); ++i) {
    const RigidTransform &X0 = coarse.X_WO[i], &X1 = fine.X_WO[i];
    limit[i].translation() = 2.0 * X1.translation() - X0.translation();
    limit[i].linear() = X1.linear() * math::exp_so3(math::log_so3(X0.linear().transpose() * X1.linear()));
  }
  return limit;
}

/// What an integrator that does not solve the equation of motion converges to. Its uncertainty is what the last
/// halving has changed.
RodReference own_limit(const RodCase& one, const std::string& shape, const std::string& integrator,
                       const RodReference& exact) {
  constexpr int kStepsPerOutput = 64;
  RodRun runs[3];
  for (int i = 0; i < 3; ++i) runs[i] = run_simulated(one, shape, integrator, kOutputInterval / (kStepsPerOutput << i));
  RodReference limit = exact;
  limit.X_WO = extrapolated(runs[1], runs[2]);
  limit.uncertainty = largest_distance(limit.X_WO, extrapolated(runs[0], runs[1])).position;
  return limit;
}

class Line {
 public:
  Line(const RodTablePlan& plan, const RodCase& one, const std::string& shape, const RodReference& exact,
       const std::string& method)
      : plan_(plan), case_(one), shape_(shape), exact_(exact), method_(method), reference_(exact) {}

  /// Of one of ours.
  std::vector<ErrorRow> rows() {
    own_ = !solves_the_equation_of_motion(method_);
    if (own_) reference_ = own_limit(case_, shape_, method_, exact_);
    model_error_ = largest_distance(reference_.X_WO, exact_.X_WO).position;
    std::vector<ErrorRow> all = rows_by_step([&](double step) { return run_simulated(case_, shape_, method_, step); });
    std::vector<ErrorRow> rows;
    for (const double tolerance : plan_.tolerances) {
      rows.push_back(row(run_in_time(plan_.tolerance_time_limit, [&] {
        return run_simulated(case_, shape_, method_, kOutputInterval, tolerance);
      })));
      ErrorRow& last = rows.back();
      last.tolerance = tolerance;
      if (last.given_up) break;
      last.error_over_tolerance = error_as_length(case_, last.error, last.angle_error) / tolerance;
      if (1e-6 * rows.back().wall_us_per_simulated_second > plan_.longest_run) break;
    }
    all.insert(all.end(), rows.begin(), rows.end());
    for (ErrorRow& row : all) row.ours = true;
    return all;
  }

  /// Of a general method.
  std::vector<ErrorRow> peer_rows() const {
    const auto run = [&](double setting) { return run_solver(case_, shape_, method_, setting); };
    if (takes_step(method_)) return rows_by_step(run);
    std::vector<ErrorRow> rows;
    for (const double tolerance : plan_.peer_tolerances) {
      rows.push_back(row(run_in_time(plan_.tolerance_time_limit,
                                     [&] { return fastest(plan_.repetition, [&] { return run(tolerance); }); })));
      rows.back().tolerance = tolerance;
      if (rows.back().given_up || line_is_over(rows, plan_.longest_run)) break;
    }
    return rows;
  }

 private:
  template <typename Run>
  std::vector<ErrorRow> rows_by_step(Run&& run) const {
    std::vector<ErrorRow> rows;
    for (const int n : plan_.steps_per_output) {
      const double step = kOutputInterval / n;
      rows.push_back(row(fastest(plan_.repetition, [&] { return run(step); })));
      rows.back().step = step;
      if (line_is_over(rows, plan_.longest_run)) break;
    }
    return rows;
  }

  ErrorRow row(const RodRun& run) const {
    ErrorRow r;
    r.scene = case_.name;
    r.shape = shape_;
    r.stiffness_factor = case_.stiffness_factor;
    r.mass = case_.mass;
    r.method = method_;
    r.hand = "samples";
    r.own_reference = own_;
    r.model_error = model_error_;
    r.reference_uncertainty = reference_.uncertainty;
    r.finite = run.finite;
    r.given_up = run.given_up;
    if (run.given_up) r.wall_us_per_simulated_second = 1e6 * plan_.tolerance_time_limit / case_.duration;
    if (!run.finite) return r;
    const PoseDistance distance = largest_distance(run.X_WO, reference_.X_WO);
    r.error = distance.position;
    r.angle_error = distance.angle;
    r.largest_deflection = reference_.largest_deflection;
    r.error_over_hand_amplitude = r.error / hand_amplitude(case_);
    r.error_over_largest_deflection = r.error / reference_.largest_deflection;
    r.wall_us_per_simulated_second = 1e6 * run.wall_seconds / case_.duration;
    r.steps_fallback = run.steps_fallback;
    r.steps_per_second = static_cast<double>(run.steps) / case_.duration;
    return r;
  }

  const RodTablePlan& plan_;
  const RodCase& case_;
  const std::string& shape_;
  const RodReference& exact_;
  const std::string& method_;
  RodReference reference_;    ///< what it is measured against
  bool own_ = false;          ///< its own limit
  double model_error_ = 0.0;  ///< how far that is from the exact one [m]
};

/// Whether general methods run a pair, too: the default shape, or that of a recording.
bool has_peers(const RodCase& one, const std::string& shape) {
  return shape == validation::name_of(rod::ForkSettings().shape) || !one.recorded.empty();
}

}  // namespace

std::size_t line_count(const RodTablePlan& plan) {
  std::size_t lines = 0;
  for (const auto& [one, shape] : pairs_of(plan.cases)) {
    lines +=
        1 + validation::names<dynamics::IntegratorKind>().size() + (has_peers(*one, shape) ? solver_names().size() : 0);
  }
  return lines;
}

std::vector<ErrorRow> rod_table(const RodTablePlan& plan, Units& units) {
  const auto pairs = pairs_of(plan.cases);
  const std::vector<RodReference> references = rod_references(pairs, units);
  std::vector<ErrorRow> all;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [one, shape] = pairs[i];
    for (const std::string& integrator : validation::names<dynamics::IntegratorKind>()) {
      Line line(plan, *one, shape, references[i], integrator);
      const std::vector<ErrorRow> rows =
          units.rows<ErrorRow>(i, one->name + ' ' + shape + ' ' + integrator, [&] { return line.rows(); });
      all.insert(all.end(), rows.begin(), rows.end());
    }
    if (!has_peers(*one, shape)) continue;
    for (const std::string& solver : solver_names()) {
      const Line line(plan, *one, shape, references[i], solver);
      const std::vector<ErrorRow> rows =
          units.rows<ErrorRow>(i, one->name + ' ' + shape + ' ' + solver, [&] { return line.peer_rows(); });
      all.insert(all.end(), rows.begin(), rows.end());
    }
  }
  return all;
}

}  // namespace spring_workbench::benchmark
