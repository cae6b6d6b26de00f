#include "benchmark/solver_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "benchmark/ode_solver.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kFarthest = 1000.0;  // m

bool is_cvode(const std::string& solver) { return solver.find("cvode") != std::string::npos; }

std::unique_ptr<OdeSolver> make_solver(const std::string& name, int size, OdeSolver::Rates rates) {
  if (name == "solver_dop853") return make_dop853(size, std::move(rates));
  if (name == "solver_radau") return make_radau(size, std::move(rates));
  if (name == "solver_arkode_erk") return make_arkode(false, size, std::move(rates));
  if (name == "solver_arkode_dirk") return make_arkode(true, size, std::move(rates));
  return make_cvode(name == "solver_cvode_adams" ? CvodeFormula::adams : CvodeFormula::bdf, size, std::move(rates));
}

/// Interface to the library: rates of the strain and its rate, and the pose of the object.
class Equations {
 public:
  Equations(const RodCase& one, const std::string& shape, const motion::FrameMotion* function)
      : body_(held_body(one, shape)), hand_(function) {
    if (function == nullptr) samples_.emplace(one.hand, one.fork.length);
  }

  const dynamics::HeldBody& body() const { return body_; }
  /// Uses the hand's segment from the sample at or before `t` to the next.
  void use_segment(double t) {
    if (!samples_ || hand_ == &samples_->handle(t)) return;
    hand_ = &samples_->handle(t);
    known_.reset();
  }
  bool rates(double t, const double* y, double* rate) const {
    const int n = body_.size();
    const dynamics::StrainState state{Eigen::Map<const Eigen::VectorXd>(y, n),
                                      Eigen::Map<const Eigen::VectorXd>(y + n, n)};
    if (!body_.shape().admissible(body_.full_state(t, state).q)) return false;
    Eigen::Map<Eigen::VectorXd>(rate, n) = state.q_dot;
    Eigen::Map<Eigen::VectorXd>(rate + n, n) = body_.acceleration(forcing(t), state.q, state.q_dot);
    return true;
  }
  RigidTransform object(double t, const double* y) const {
    const int n = body_.size();
    return body_
        .object(forcing(t), {Eigen::Map<const Eigen::VectorXd>(y, n), Eigen::Map<const Eigen::VectorXd>(y + n, n)})
        .X;
  }

 private:
  /// The hand at `t`, cached for repeated calls with the same time.
  const dynamics::HandleForcing& forcing(double t) const {
    if (!known_ || known_->t != t) known_ = body_.forcing(*hand_, t);
    return *known_;
  }

  dynamics::HeldBody body_;
  std::optional<SampledHand> samples_;
  const motion::FrameMotion* hand_;
  mutable std::optional<dynamics::HandleForcing> known_;
};

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

/// The classical method with equal steps of at most `step` [s] up to a stop; cubic Hermite interpolation between their
/// ends.
class RungeKutta4 final : public OdeSolver {
 public:
  RungeKutta4(int size, double step, Rates rates) : rates_(std::move(rates)), step_(step), y_(size) {}

  void begin(double t, const std::vector<double>& y, double, const std::vector<double>&) override {
    t_ = before_ = t;
    y_ = Eigen::Map<const Eigen::VectorXd>(y.data(), y_.size());
    rate_ = stage(t_, y_);
  }
  const double* advance(double t, bool stop_there) override {
    if (stop_there) rate_ = stage(t_, y_);  // the rates may have jumped
    while (t_ < t - kSameTime) step(stop_there ? (t - t_) / std::ceil((t - t_) / step_ * (1.0 - 1e-9)) : step_);
    if (t_ < t + kSameTime) return y_.data();
    const double h = t_ - before_, u = (t - before_) / h, v = 1.0 - u;
    output_ = v * from_ + u * y_ + u * v * (v * (h * from_rate_ - (y_ - from_)) - u * (h * rate_ - (y_ - from_)));
    return output_.data();
  }

 private:
  using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;
  void step(double h) {
    const State k2 = stage(t_ + 0.5 * h, y_ + 0.5 * h * rate_), k3 = stage(t_ + 0.5 * h, y_ + 0.5 * h * k2),
                k4 = stage(t_ + h, y_ + h * k3);
    from_ = y_;
    from_rate_ = rate_;
    before_ = t_;
    y_ += h / 6.0 * (rate_ + 2.0 * (k2 + k3) + k4);
    t_ += h;
    rate_ = stage(t_, y_);
  }
  State stage(double t, const State& y) const {
    State rate(y.size());
    if (!y.allFinite() || !rates_(t, y.data(), rate.data())) throw std::runtime_error("RK4 has left the range");
    return rate;
  }

  Rates rates_;
  double step_, t_ = 0.0, before_ = 0.0;
  State y_, rate_, from_, from_rate_, output_;
};

}  // namespace

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names = {"solver_rk4",        "solver_dop853",      "solver_radau",
                                                 "solver_cvode_bdf",  "solver_cvode_adams", "solver_arkode_erk",
                                                 "solver_arkode_dirk"};
  return names;
}

bool takes_step(const std::string& solver) { return solver == "solver_rk4"; }

RodRun run_solver(const RodCase& one, const std::string& shape, const std::string& name, double setting,
                  const motion::FrameMotion* function) {
  using Clock = std::chrono::steady_clock;
  Equations equations(one, shape, function);
  const int size = 2 * equations.body().size();
  const bool by_segments = function == nullptr, every_segment = by_segments && !is_cvode(name);
  OdeSolver::Rates rates = [&equations](double t, const double* y, double* rate) {
    return equations.rates(t, y, rate);
  };
  if (by_segments && !every_segment) {
    rates = [&equations](double t, const double* y, double* rate) {
      equations.use_segment(t);
      return equations.rates(t, y, rate);
    };
  }
  const std::unique_ptr<OdeSolver> solver =
      takes_step(name) ? std::make_unique<RungeKutta4>(size, setting, rates) : make_solver(name, size, rates);
  const std::vector<double> start(static_cast<std::size_t>(size), 0.0), scale = scale_of(one, equations.body());
  const std::vector<double> times = output_times(one), ends = every_segment ? step_ends(one) : times;
  RodRun run;
  run.X_WO.reserve(times.size());
  equations.use_segment(0.0);
  const Clock::time_point begun = Clock::now();
  try {
    run.X_WO.push_back(equations.object(0.0, start.data()));
    solver->begin(0.0, start, setting, scale);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (by_segments) equations.use_segment(0.5 * (ends[i] + ends[i + 1]));
      const double* y = solver->advance(ends[i + 1], every_segment);
      if (ends[i + 1] < times[run.X_WO.size()] - kSameTime) continue;
      if (by_segments) equations.use_segment(ends[i + 1]);
      run.X_WO.push_back(equations.object(ends[i + 1], y));
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
