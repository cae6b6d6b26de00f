#include "benchmark/rod_table.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include "benchmark/our_methods.h"
#include "benchmark/parallel.h"
#include "benchmark/rod_reference.h"
#include "benchmark/simulated_rod.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/run_in_child.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kSameTime = 1e-9;  // s
constexpr double kOutputInterval = 0.02;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

bool is_bounded(const RigidTransform& X) {
  return X.matrix().allFinite() && X.translation().cwiseAbs().maxCoeff() < 1000.0;
}

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
  plan.longest_run = quick ? 0.005 : 0.025;
  plan.tolerance_time_limit = quick ? 0.1 : 1.0;
  plan.repetition = quick ? Repetition{1, 0.005} : Repetition{3, 0.05};
  return plan;
}

RodRun run_rod(const RodCase& one, const std::string& shape, const std::string& integrator_name, double step) {
  const dynamics::HeldBody body = held_body(one, shape);
  const std::unique_ptr<dynamics::Integrator> integrator = dynamics::make_integrator(
      validation::named<dynamics::IntegratorKind>(integrator_name, "benchmark", "integrator"));
  dynamics::StrainState state = body.zero_state();
  motion::PoseTrack track = hand_track(one);
  const std::vector<double> ends = step_ends(one), times = output_times(one);
  RodRun run;
  run.X_WO.reserve(times.size());
  run.X_WO.push_back(body.object(body.forcing(track.segment(0.0), 0.0), state).X);
  const Clock::time_point start = Clock::now();
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double span = ends[i + 1] - ends[i];
    const motion::MotionSegment& segment = track.segment(ends[i] + 0.5 * span);
    const int count = static_cast<int>(std::ceil(span / step * (1.0 - 1e-9)));
    const double h = span / count;
    for (int j = 0; j < count; ++j) integrator->step(body, segment, ends[i] + j * h, h, state);
    run.steps += count;
    if (ends[i + 1] < times[run.X_WO.size()] - kSameTime) continue;
    run.X_WO.push_back(body.object(body.forcing(segment, ends[i + 1]), state).X);
    if (!is_bounded(run.X_WO.back())) return run;
  }
  run.wall_seconds = seconds_since(start);
  run.finite = true;
  return run;
}

RodRun run_rod_to_tolerance(const RodCase& one, const std::string& shape, const std::string& integrator,
                            double tolerance) {
  simulation::SimulationSettings settings = rod_settings(one, shape, integrator, kOutputInterval);
  YAML::Node values;
  values["tolerance"] = tolerance;
  simulation::apply_settings(values, "report", settings);
  simulation::Simulation simulation(rod_scene(one), settings);
  for (const motion::PoseSample& sample : one.hand) simulation.push_stylus(sample);
  RodRun run;
  const std::vector<double> times = output_times(one);
  run.X_WO.reserve(times.size());
  const Clock::time_point start = Clock::now();
  for (const double t : times) {
    const simulation::AdvanceReport report = simulation.advance(t);
    run.steps += report.steps;
    run.X_WO.push_back(simulation.objects()[0].X_WO);
    if (!is_bounded(run.X_WO.back()) || report.steps_rejected > 0) return run;
  }
  run.wall_seconds = seconds_since(start);
  run.finite = true;
  return run;
}

double error_as_length(const RodCase& one, double position, double angle) {
  return std::max(position, angle * std::sqrt(0.5 * one.inertia.sum() / one.mass));
}

std::size_t line_count(const RodTablePlan& plan) {
  std::size_t pairs = 0;
  for (const RodCase& one : plan.cases) pairs += one.shapes.size();
  return pairs * (1 + validation::names<dynamics::IntegratorKind>().size());
}

namespace {

/// What comes before the poses.
struct Header {
  double wall_seconds;
  long steps;
  bool finite;
};

using PoseNumbers = Eigen::Matrix<double, 3, 4>;

std::string packed(const RodRun& run) {
  const Header header{run.wall_seconds, run.steps, run.finite};
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
RodRun run_rod_to_tolerance_isolated(const RodCase& one, const std::string& shape, const std::string& integrator,
                                     double tolerance, double time_limit) {
  const auto data = validation::run_in_child(
      [&] { return packed(run_rod_to_tolerance(one, shape, integrator, tolerance)); }, {time_limit});
  if (data) return unpacked(*data);
  RodRun run;
  run.given_up = true;
  return run;
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
  for (int i = 0; i < 3; ++i) runs[i] = run_rod(one, shape, integrator, kOutputInterval / (kStepsPerOutput << i));
  RodReference limit = exact;
  limit.X_WO = extrapolated(runs[1], runs[2]);
  limit.uncertainty = largest_distance(limit.X_WO, extrapolated(runs[0], runs[1])).position;
  return limit;
}

class Line {
 public:
  Line(const RodTablePlan& plan, const RodCase& one, const std::string& shape, const RodReference& exact,
       const std::string& integrator)
      : plan_(plan), case_(one), shape_(shape), exact_(exact), integrator_(integrator) {}

  std::vector<ErrorRow> rows() {
    own_ = !solves_the_equation_of_motion(integrator_);
    reference_ = own_ ? own_limit(case_, shape_, integrator_, exact_) : exact_;
    model_error_ = largest_distance(reference_.X_WO, exact_.X_WO).position;
    std::vector<ErrorRow> all, rows;
    for (const int n : plan_.steps_per_output) {
      const double step = kOutputInterval / n;
      rows.push_back(row(fastest(plan_.repetition, [&] { return run_rod(case_, shape_, integrator_, step); })));
      rows.back().step = step;
      if (line_is_over(rows, plan_.longest_run)) break;
    }
    all.insert(all.end(), rows.begin(), rows.end());
    rows.clear();
    for (const double tolerance : plan_.tolerances) {
      rows.push_back(
          row(run_rod_to_tolerance_isolated(case_, shape_, integrator_, tolerance, plan_.tolerance_time_limit)));
      ErrorRow& last = rows.back();
      last.tolerance = tolerance;
      if (last.given_up) break;
      last.error_over_tolerance = error_as_length(case_, last.error, last.angle_error) / tolerance;
      if (1e-6 * rows.back().wall_us_per_simulated_second > plan_.longest_run) break;
    }
    all.insert(all.end(), rows.begin(), rows.end());
    return all;
  }

 private:
  ErrorRow row(const RodRun& run) const {
    ErrorRow r;
    r.scene = case_.name;
    r.shape = shape_;
    r.method = integrator_;
    r.hand = "samples";
    r.own_reference = own_;
    r.model_error = model_error_;
    r.reference_uncertainty = reference_.uncertainty;
    r.finite = run.finite;
    r.given_up = run.given_up;
    if (!run.finite) return r;
    const PoseDistance distance = largest_distance(run.X_WO, reference_.X_WO);
    r.error = distance.position;
    r.angle_error = distance.angle;
    r.error_over_hand_amplitude = r.error / hand_amplitude(case_);
    r.error_over_largest_deflection = r.error / reference_.largest_deflection;
    r.wall_us_per_simulated_second = 1e6 * run.wall_seconds / case_.duration;
    r.steps_per_second = static_cast<double>(run.steps) / case_.duration;
    return r;
  }

  const RodTablePlan& plan_;
  const RodCase& case_;
  const std::string& shape_;
  const RodReference& exact_;
  const std::string& integrator_;
  RodReference reference_;    ///< what it is measured against
  bool own_ = false;          ///< its own limit
  double model_error_ = 0.0;  ///< how far that is from the exact one [m]
};

}  // namespace

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
  }
  return all;
}

}  // namespace spring_workbench::benchmark
