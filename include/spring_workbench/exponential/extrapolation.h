#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "spring_workbench/exponential/collocation.h"
#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::exponential {

/// The collocation polynomials of `n` functions over the last step, extrapolated to the next step as the initial guess
/// of its iteration.
template <int n>
class Extrapolation {
 public:
  using NodeValues = std::array<math::Pack, n>;  ///< lane i: at node i

  /// Keeps the values over a step of `h` from `t` [s]; `t` NaN: nothing to extrapolate.
  void keep(double t, double h, const NodeValues& values) {
    values_ = values;
    h_ = h;
    t_begin_ = t;
  }
  void clear() { t_begin_ = std::numeric_limits<double>::quiet_NaN(); }
  bool empty() const { return std::isnan(t_begin_); }

  /// Computes the values over a step of `h` from `t` [s], which may follow the last step or repeat it with another
  /// length. Returns false, without values, if the step begins before the last one or extends too far beyond it.
  SPRING_WORKBENCH_INLINE bool extrapolate(double t, double h, NodeValues& values) const {
    const double begin = (t - t_begin_) / h_, length = h / h_;  // in units of the last step
    if (!(begin > -same_time && begin + length < 1.0 + farthest)) return false;
    for (std::size_t k = 0; k < Collocation::count; ++k) {
      const auto w = Collocation::interpolated(begin + Collocation::nodes[k] * length);
      const math::Pack weights{w[0], w[1], w[2], w[3]};
      for (std::size_t i = 0; i < values.size(); ++i) values[i][k] = math::sum(weights * values_[i]);
    }
    return true;
  }

  void archive(math::StateArchive& state) { state(values_, h_, t_begin_); }

 private:
  static constexpr double farthest = 1.5;  ///< largest distance beyond the end of the last step, in units of that step
  static constexpr double same_time = 1e-9;  ///< in units of the step; rounding error of equal moments

  NodeValues values_{};
  double h_ = 0.0, t_begin_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace spring_workbench::exponential
