#include "benchmark/solver_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "benchmark/ode_solver.h"
#include "spring_workbench/math/by_size.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kFarthest = 1000.0;  // m

bool contains(const std::string& name, const char* part) { return name.find(part) != std::string::npos; }

/// `setting`: the step [s] of a method that takes one.
std::unique_ptr<OdeSolver> make_solver(const std::string& name, int size, double setting, OdeSolver::Rates rates) {
  if (name == "solver_rk4") return make_rk4(size, setting, std::move(rates));
  if (name == "solver_implicit_euler") return make_implicit_euler(size, setting, std::move(rates));
  if (contains(name, "dop853")) return make_dop853(size, std::move(rates));
  if (contains(name, "radau")) return make_radau(size, std::move(rates));
  if (contains(name, "arkode")) return make_arkode(contains(name, "dirk"), size, std::move(rates));
  return make_cvode(contains(name, "adams") ? CvodeFormula::adams : CvodeFormula::bdf, size, std::move(rates));
}

/// Interface to the library: rates of the strain and its rate, and the pose of the object.
class Equations {
 public:
  Equations(const RodCase& one, const std::string& shape, const motion::Trajectory* function)
      : body_(held_body(one, shape)), hand_(function) {
    if (function == nullptr) samples_.emplace(one.hand, one.fork.length);
    for (int i = 0; i < body_.size(); ++i) inside_[static_cast<std::size_t>(i)] = 1.0 / admissible_strain(i);
  }

  const dynamics::HeldBody& body() const { return body_; }
  /// Uses the hand's segment from the sample at or before `t` to the next.
  void use_segment(double t) {
    if (!samples_ || hand_ == &samples_->handle(t)) return;
    hand_ = &samples_->handle(t);
    known_.reset();
  }
  /// The rates of 2 n = 2 body().size() entries.
  template <int n>
  bool rates(double t, const double* y, double* rate) const {
    using Strain = Eigen::Matrix<double, n, 1>;
    const Strain q = Eigen::Map<const Strain>(y), q_dot = Eigen::Map<const Strain>(y + n);
    if (!is_admissible(t, q)) return false;
    Eigen::Map<Strain>{rate} = q_dot;
    Eigen::Map<Strain>{rate + n} = body_.acceleration<n>(forcing(t), q, q_dot);
    return true;
  }
  RigidTransform object(double t, const double* y) const {
    const int n = body_.size();
    return body_
        .object(forcing(t), {Eigen::Map<const Eigen::VectorXd>(y, n), Eigen::Map<const Eigen::VectorXd>(y + n, n)})
        .X;
  }

 private:
  /// A strain of coordinate `i`, the others zero, that is admissible with either sign.
  double admissible_strain(int i) const {
    const auto fits = [&](double strain) {
      dynamics::StrainState state = body_.zero_state();
      state.q[i] = strain;
      return body_.shape().admissible(body_.full_state(0.0, state).q);
    };
    double strain = 64.0;
    while (!fits(strain) || !fits(-strain)) strain *= 0.5;
    return strain;
  }
  /// Whether a strain is admissible. The shape is asked only outside the hull of the strains admissible_strain(),
  /// inside which all are, since the range is convex.
  template <int n>
  bool is_admissible(double t, const Eigen::Matrix<double, n, 1>& q) const {
    if (q.cwiseAbs().dot(Eigen::Map<const Eigen::Matrix<double, n, 1>>(inside_.data())) < 1.0) return true;
    return body_.shape().admissible(body_.full_state(t, {q, Eigen::Matrix<double, n, 1>::Zero()}).q);
  }
  /// The hand at `t`, cached for repeated calls with the same time.
  const dynamics::HandleState& forcing(double t) const {
    if (!known_ || known_->t != t) known_ = body_.state_at(*hand_, t);
    return *known_;
  }

  dynamics::HeldBody body_;
  std::array<double, rod::max_strain_coordinates> inside_{};
  std::optional<SampledHand> samples_;
  const motion::Trajectory* hand_;
  mutable std::optional<dynamics::HandleState> known_;
};

/// The rates for the number of coordinates; with `through`, with the hand's segment at each time.
OdeSolver::Rates rates_of(Equations& equations, bool through) {
  return math::by_size(equations.body().size(), [&](auto size) -> OdeSolver::Rates {
    constexpr int n = decltype(size)::value;
    if (!through) return [&equations](double t, const double* y, double* r) { return equations.rates<n>(t, y, r); };
    return [&equations](double t, const double* y, double* r) {
      equations.use_segment(t);
      return equations.rates<n>(t, y, r);
    };
  });
}

/// Scale of the absolute tolerances. For strains roughly the static strain; for rates, the error that causes the same
/// relative error of the strains for uncoupled oscillations, since only the pose of the object matters.
std::vector<double> scale_of(const RodCase& one, const dynamics::HeldBody& body) {
  const int n = body.size();
  const rod::StrainMatrix mass = body.mass_matrix(0.0, body.zero_state().q);
  std::vector<double> scale(static_cast<std::size_t>(2 * n));
  for (int i = 0; i < n; ++i) {
    const double strain = std::min(one.mass * 9.81 * one.fork.length / body.stiffness()[i], 1.0);
    scale[static_cast<std::size_t>(i)] = strain;
    scale[static_cast<std::size_t>(n + i)] = std::max(10.0, std::sqrt(body.stiffness()[i] / mass(i, i))) * strain;
  }
  return scale;
}

/// The times at which a step has to end, after the start and in order; the last output is one.
std::vector<double> ends_of_steps(const RodCase& one, StepEnds at) {
  std::vector<double> ends = step_ends(one);
  ends.erase(ends.begin());
  if (at == StepEnds::samples_and_outputs) return ends;
  const auto is_sample = [&](double t) {
    return std::any_of(one.hand.begin(), one.hand.end(),
                       [&](const motion::PoseSample& sample) { return std::abs(sample.t - t) < kSameTime; });
  };
  ends.erase(std::remove_if(ends.begin(), std::prev(ends.end()), [&](double t) { return !is_sample(t); }),
             std::prev(ends.end()));
  return ends;
}

}  // namespace

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names = {"solver_rk4",
                                                 "solver_implicit_euler",
                                                 "solver_dop853",
                                                 "solver_radau",
                                                 "solver_cvode_bdf",
                                                 "solver_cvode_adams",
                                                 "solver_cvode_bdf_restarted",
                                                 "solver_cvode_adams_restarted",
                                                 "solver_arkode_erk",
                                                 "solver_arkode_dirk",
                                                 "solver_dop853_through",
                                                 "solver_radau_through",
                                                 "solver_arkode_erk_through"};
  return names;
}

bool runs_through(const std::string& solver) {
  return solver == "solver_cvode_bdf" || solver == "solver_cvode_adams" || contains(solver, "_through");
}

bool takes_step(const std::string& solver) { return solver == "solver_rk4" || solver == "solver_implicit_euler"; }

bool is_for_samples(const std::string& solver) {
  return contains(solver, "_restarted") || contains(solver, "_through");
}

bool gains_from_long_steps(const std::string& solver) {
  return solver == "solver_radau" || solver == "solver_cvode_bdf_restarted";
}

RodRun run_solver(const RodCase& one, const std::string& shape, const std::string& name, double setting,
                  StepEnds step_ends_at, const motion::Trajectory* function) {
  using Clock = std::chrono::steady_clock;
  Equations equations(one, shape, function);
  const int size = 2 * equations.body().size();
  const bool by_segments = function == nullptr, stops = by_segments && !runs_through(name);
  const OdeSolver::Rates rates = rates_of(equations, by_segments && !stops);
  const std::unique_ptr<OdeSolver> solver = make_solver(name, size, setting, rates);
  const std::vector<double> start(static_cast<std::size_t>(size), 0.0), scale = scale_of(one, equations.body());
  const std::vector<double> times = output_times(one), stations = stops ? step_ends(one) : times;
  const std::vector<double> ends = stops ? ends_of_steps(one, step_ends_at) : std::vector<double>{kNever};
  RodRun run;
  run.X_WO.reserve(times.size());
  equations.use_segment(0.0);
  const Clock::time_point begun = Clock::now();
  try {
    run.X_WO.push_back(equations.object(0.0, start.data()));
    solver->begin(0.0, start, setting, scale);
    auto end = ends.begin();
    for (std::size_t i = 1; i < stations.size(); ++i) {
      const double t = stations[i];
      if (by_segments) equations.use_segment(0.5 * (stations[i - 1] + t));
      const double* y = solver->advance(t, *end);
      if (t == *end) ++end;
      if (t < times[run.X_WO.size()] - kSameTime) continue;
      if (by_segments) equations.use_segment(t);
      run.X_WO.push_back(equations.object(t, y));
      const RigidTransform& X = run.X_WO.back();
      if (!X.matrix().allFinite() || X.translation().norm() > kFarthest) return run;
    }
  } catch (const std::runtime_error&) {
    return run;
  }
  run.wall_seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  run.finite = true;
  return run;
}

}  // namespace spring_workbench::benchmark
