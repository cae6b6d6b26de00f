#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "benchmark/ode_solver.h"

namespace spring_workbench::benchmark {

/// A solver that chooses its own step sizes: makes steps end at requested times.
class AdaptiveSolver : public OdeSolver {
 public:
  static constexpr int max_equations = 12;
  using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_equations, 1>;

  const double* advance(double t, double stop) final {
    while (t_ < t) {
      const double left = stop - t_;
      if (left < 1e-12 * std::max(1.0, std::abs(t))) {
        t_ = stop;
        break;
      }
      step(left);
    }
    if (t == stop) rates_known_ = false;
    if (t >= t_) return y_.data();
    output_ = within_last_step((t - before_) / (t_ - before_));
    return output_.data();
  }

 protected:
  void set_start(double t, const std::vector<double>& y, double tolerance, const std::vector<double>& scale) {
    const auto size = static_cast<Eigen::Index>(y.size());
    t_ = before_ = t;
    y_ = Eigen::Map<const Eigen::VectorXd>(y.data(), size);
    tolerance_ = tolerance;
    absolute_ = tolerance * Eigen::Map<const Eigen::VectorXd>(scale.data(), size);
    h_ = 0.0;
    rates_known_ = false;
  }
  static double norm(const State& v, const State& scale) {
    return std::sqrt(v.cwiseQuotient(scale).squaredNorm() / static_cast<double>(v.size()));
  }

  double t_ = 0.0, before_ = 0.0;  ///< end and start of the last step
  double h_ = 0.0;                 ///< size of the next step; 0: not determined yet
  double tolerance_ = 0.0;
  State y_, absolute_;        ///< state at t_; absolute tolerances
  bool rates_known_ = false;  ///< whether the rates at t_ are known

 private:
  /// Takes a step of at most `longest`.
  virtual void step(double longest) = 0;
  /// The state after a fraction `share` of the last step.
  virtual State within_last_step(double share) = 0;

  State output_;
};

}  // namespace spring_workbench::benchmark
