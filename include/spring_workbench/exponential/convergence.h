#pragma once

#include <algorithm>
#include <cmath>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::exponential {

/// Decides when a fixed-point iteration ends. It predicts from the rate of convergence how much further iterations
/// would still change (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8, equation (8.10)), and
/// compares this with the collocation error of the step, which no iteration reduces. All sizes are squared norms.
class Convergence {
 public:
  /// Assumes nothing about the next step from those before.
  void restart() {
    rate_ = 1.0;
    squared_error_ = 0.0;
  }
  void begin_step() {
    iterations_ = 0;
    squared_before_ = left_ = 0.0;
    rate_ = present_rate_ = std::min(1.0, rate_ * rate_growth);
    ended_ = converged_ = cancelled_ = false;
  }
  /// Records an iteration: the squared size of its change at all nodes and at the end of the step, and that of the
  /// rounding errors of the result. `cancelled_rounding` returns an upper bound of the squared rounding errors of terms
  /// that cancel; it is called only if the iteration stalls.
  template <typename CancelledRounding>
  void add(double squared_change, double squared_change_at_end, double squared_rounding,
           const CancelledRounding& cancelled_rounding) {
    ++iterations_;
    if (iterations_ > 1) present_rate_ = std::sqrt(squared_change / squared_before_);
    if (iterations_ == 2) rate_ = present_rate_;
    squared_before_ = squared_change;
    const bool slow = iterations_ > 2 && present_rate_ > slow_rate && squared_change > squared_rounding;
    cancelled_ = slow && squared_change <= cancelled_rounding();
    ended_ = cancelled_ || (slow && iterations_ > iterations_to_judge) || iterations_ == max_iterations;
    left_ = cancelled_ ? 1.0 : left_at(present_rate_);  // 1: the next iteration changes as much again
    squared_left_ = left_ * left_ * squared_change_at_end;
    squared_rounding_ = squared_rounding;
  }
  /// Whether the iteration should end, judged by the collocation error of the last step.
  bool may_end() const { return ended_ || is_below(fraction_to_end); }
  /// Sets the squared collocation error of this step, by which it decides whether the iteration has converged.
  void set_error(double squared_error) {
    squared_error_ = squared_error;
    converged_ = cancelled_ || is_below(max_fraction);
    ended_ = ended_ || converged_;
  }
  bool ended() const { return ended_; }
  bool converged() const { return converged_; }
  int iterations() const { return iterations_; }
  /// Predicted sum of all further changes, relative to the last one.
  double left() const { return left_; }
  /// Predicted sum of all changes after the first iteration, relative to the change of that iteration.
  double left_after_first() const { return left_at(rate_); }

  void archive(math::StateArchive& state) { state(rate_, squared_error_); }

  static constexpr int max_iterations = 12;
  /// The iteration ends when further iterations would change less than the first fraction of the last step's
  /// collocation error; it has converged if that is also less than the second fraction of this step's.
  static constexpr double fraction_to_end = 0.02, max_fraction = 0.1;

 private:
  /// After this many iterations, one that leaves more than slow_rate of the last change ends the step.
  static constexpr int iterations_to_judge = 5;
  static constexpr double slow_rate = 0.7;
  /// Factor by which the rate is assumed to grow from one step to the next, until a step with two iterations measures
  /// it: the rate is lowest at the linear part. An empirical value. Without growth, an old rate ends steps too early
  /// (Convergence.DoesNotRelyOnTheRateOfAnOldStep); with 1e9, which amounts to no rate at all, the default fork, the
  /// reference trajectories and the error bounds are as with 1.3, but a step in which load and springs cancel is halved
  /// (StepControl.GoesOnInWholeStepsWhereALoadAndTheSpringsCancel).
  static constexpr double rate_growth = 1.3;
  static constexpr double left_at_unknown = 1e3;  ///< left() at an unknown rate, or without convergence

  static double left_at(double rate) { return rate < 1.0 ? rate / (1.0 - rate) : left_at_unknown; }
  bool is_below(double fraction) const {
    return squared_left_ <= std::max(fraction * fraction * squared_error_, squared_rounding_);
  }

  double rate_ = 1.0;           ///< from the first to the second iteration; assumed if a step has only one
  double squared_error_ = 0.0;  ///< collocation error of the last step
  // Of the present step.
  int iterations_ = 0;
  double present_rate_ = 1.0, squared_before_ = 0.0, left_ = 0.0, squared_left_ = 0.0, squared_rounding_ = 0.0;
  bool ended_ = false, converged_ = false, cancelled_ = false;
};

}  // namespace spring_workbench::exponential
