#pragma once

#include "spring_workbench/exponential/extrapolation.h"

namespace spring_workbench::exponential {

/// The residual of the last step of `n` coordinates, from which the iteration of the next one starts. The stored
/// quantity is the residual plus the linear part at the start of the step, minus the first-order effect of the forcing:
/// this is smooth even if the forcing jumps, and does not depend on where a step begins.
template <int n>
class ResidualHistory {
 public:
  using Strain = Eigen::Matrix<double, n, 1>;
  using NodeStrains = typename Extrapolation<n>::NodeValues;

  /// Keeps the residual at the nodes of a step of `h` from `t` [s]. `linear`: S q + D q̇ at its start; `by_forcing`: the
  /// acceleration due to the forcing alone, to first order.
  SPRING_WORKBENCH_INLINE void keep(double t, double h, const Strain& linear, const NodeStrains& by_forcing,
                                    NodeStrains residual) {
    for (std::size_t i = 0; i < n; ++i) residual[i] = residual[i] - by_forcing[i] + linear[static_cast<int>(i)];
    smooth_.keep(t, h, residual);
  }
  void clear() { smooth_.clear(); }
  bool empty() const { return smooth_.empty(); }

  /// Computes the residual that a step of `h` from `t` [s] would have if the last polynomial continued. Returns false
  /// if it cannot (Extrapolation).
  SPRING_WORKBENCH_INLINE bool extrapolate(double t, double h, const Strain& linear, const NodeStrains& by_forcing,
                                           NodeStrains& residual) const {
    if (!smooth_.extrapolate(t, h, residual)) return false;
    for (std::size_t i = 0; i < n; ++i) residual[i] = residual[i] - linear[static_cast<int>(i)] + by_forcing[i];
    return true;
  }

  void archive(math::StateArchive& state) { state(smooth_); }

 private:
  Extrapolation<n> smooth_;
};

}  // namespace spring_workbench::exponential
