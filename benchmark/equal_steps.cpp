#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "benchmark/adaptive_solver.h"
#include "benchmark/rod_case.h"

namespace spring_workbench::benchmark {
namespace {

/// Equal steps of at most `step` [s] up to a stop, with an interpolation between their ends.
class EqualSteps : public OdeSolver {
 public:
  using State = AdaptiveSolver::State;

  EqualSteps(int size, double step, Rates rates) : y_(size), rates_(std::move(rates)), step_(step) {}

  void begin(double t, const std::vector<double>& y, double, const std::vector<double>& scale) override {
    t_ = before_ = t;
    y_ = Eigen::Map<const Eigen::VectorXd>(y.data(), y_.size());
    start(scale);
  }
  const double* advance(double t, double stop) override {
    while (t_ < t - kSameTime) {
      const double h = stop < kNever ? (stop - t_) / std::ceil((stop - t_) / step_ * (1.0 - 1e-9)) : step_;
      State next = y_;
      step(h, next);
      before_ = std::exchange(t_, t_ + h);
      from_ = std::exchange(y_, next);
    }
    if (t == stop) jump();
    if (t_ < t + kSameTime) return y_.data();
    output_ = between(t_ - before_, (t - before_) / (t_ - before_));
    return output_.data();
  }

 protected:
  virtual void start(const std::vector<double>& scale) = 0;
  virtual void step(double h, State& y) = 0;  ///< from `y` at t_
  virtual void jump() {}                      ///< the rate may jump at t_
  /// At the fraction `u` of the last step, of `h` [s].
  virtual State between(double h, double u) = 0;
  State rate(double t, const State& y) const {
    State rate(y.size());
    if (!y.allFinite() || !rates_(t, y.data(), rate.data())) throw std::runtime_error("a step has left the range");
    return rate;
  }

  double t_ = 0.0, before_ = 0.0;  ///< end and start of the last step [s]
  State y_, from_;                 ///< the states there

 private:
  Rates rates_;
  double step_;
  State output_;
};

/// With cubic Hermite interpolation.
class RungeKutta4 final : public EqualSteps {
 public:
  using EqualSteps::EqualSteps;

 private:
  void start(const std::vector<double>&) override { known_ = false; }
  void jump() override { known_ = false; }
  void find_rate() {
    if (!known_) rate_ = rate(t_, y_);
    known_ = true;
  }
  void step(double h, State& y) override {
    find_rate();
    const State k2 = rate(t_ + 0.5 * h, y + 0.5 * h * rate_), k3 = rate(t_ + 0.5 * h, y + 0.5 * h * k2),
                k4 = rate(t_ + h, y + h * k3);
    y += h / 6.0 * (rate_ + 2.0 * (k2 + k3) + k4);
    from_rate_ = rate_;
    known_ = false;
  }
  State between(double h, double u) override {
    find_rate();
    const double v = 1.0 - u;
    return v * from_ + u * y_ + u * v * (v * (h * from_rate_ - (y_ - from_)) - u * (h * rate_ - (y_ - from_)));
  }

  State rate_, from_rate_;
  bool known_ = false;  ///< whether rate_ is that at t_
};

/// With linear interpolation.
class ImplicitEuler final : public EqualSteps {
 public:
  using EqualSteps::EqualSteps;

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, AdaptiveSolver::max_equations,
                               AdaptiveSolver::max_equations>;
  void start(const std::vector<double>& scale) override {
    const State here = rate(t_, y_);
    jacobian_.resize(y_.size(), y_.size());
    for (Eigen::Index i = 0; i < y_.size(); ++i) {
      State moved = y_;
      moved[i] += 1.5e-8 * std::max(std::abs(y_[i]), scale[static_cast<std::size_t>(i)]);
      jacobian_.col(i) = (rate(t_, moved) - here) / (moved[i] - y_[i]);
    }
    factored_for_ = 0.0;
  }
  void step(double h, State& y) override {
    if (std::abs(h - factored_for_) > 1e-9 * h) {
      factors_.compute(Matrix::Identity(y.size(), y.size()) - h * jacobian_);
      factored_for_ = h;
    }
    y += h * factors_.solve(rate(t_ + h, y));
  }
  State between(double, double u) override { return from_ + u * (y_ - from_); }

  Matrix jacobian_;
  Eigen::PartialPivLU<Matrix> factors_;
  double factored_for_ = 0.0;  ///< the step [s]
};

}  // namespace

std::unique_ptr<OdeSolver> make_rk4(int size, double step, OdeSolver::Rates rates) {
  return std::make_unique<RungeKutta4>(size, step, std::move(rates));
}

std::unique_ptr<OdeSolver> make_implicit_euler(int size, double step, OdeSolver::Rates rates) {
  return std::make_unique<ImplicitEuler>(size, step, std::move(rates));
}

}  // namespace spring_workbench::benchmark
