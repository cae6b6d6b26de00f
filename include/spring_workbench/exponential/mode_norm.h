#pragma once

#include <algorithm>

#include "spring_workbench/exponential/modal_rates.h"

namespace spring_workbench::exponential {

/// Norm of `count` modes over a step, by which the iteration and its errors are judged. Displacements have the
/// weight 1. Rates are weighted by the time in which they act: the step or, if that is shorter, the time 1/|rate| of
/// their mode.
template <int count>
class ModeNorm {
 public:
  using Modes = Eigen::Matrix<double, count, 1>;

  /// Sets the weights for steps of `h` [s].
  void set(double h, const ModalRates& rates) {
    for (int m = 0; m < count; ++m) {
      const double weight = 1.0 / std::max(1.0 / h, rates.size(m));
      squared_weight_[m] = weight * weight;
    }
  }
  /// Squared weights, one per mode.
  const Modes& squared_weight() const { return squared_weight_; }
  SPRING_WORKBENCH_INLINE double squared_size(const Modes& x) const { return squared_weight_.dot(x.cwiseAbs2()); }
  /// Upper bound of the squared size of the change over a step due to derivatives of this size.
  double squared_effect(const Modes& derivatives) const {
    return squared_size(derivatives.cwiseProduct(squared_weight_.cwiseSqrt()));
  }

 private:
  Modes squared_weight_ = Modes::Zero();
};

}  // namespace spring_workbench::exponential
