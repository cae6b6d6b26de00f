#pragma once

#include <algorithm>
#include <cmath>

#include "modal_decomposition.h"
#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::dynamics {

/// Carries RunError::spread along the linear part of a `Collocation` (math::ExponentialCollocation).
template <int n, typename Collocation>
class ErrorSpread {
 public:
  void set(const ModalDecomposition& modes) {
    swing_rates_ = modes.swing_rates;
    mass_ = modes.mass;
    to_undamped_ = modes.to_undamped;
    const Square back = modes.inverse_mass * modes.to_undamped.transpose();
    ball_.setZero();
    ball_.template topLeftCorner<n, n>() = back * back.transpose();
    ball_.template bottomRightCorner<n, n>() = back * swing_rates_.cwiseAbs2().asDiagonal() * back.transpose();
    h_ = 0.0;
  }

  /// How far deviations, one in each lane, swing or run out, all modes together [m √kg].
  SPRING_WORKBENCH_INLINE math::Pack amplitude(const Collocation& collocation,
                                               const typename Collocation::NodeModes& x) const {
    typename Collocation::NodeStrains q, q_dot;
    collocation.deviation(x, q, q_dot);
    math::Pack squared{};
    for (int i = 0; i < n; ++i) {
      math::Pack displacement{}, velocity{};
      for (int j = 0; j < n; ++j) {
        displacement += to_undamped_(i, j) * q[Collocation::at(j)];
        velocity += to_undamped_(i, j) * q_dot[Collocation::at(j)];
      }
      squared += displacement * displacement + velocity * velocity / (swing_rates_[i] * swing_rates_[i]);
    }
    for (int k = 0; k < math::pack_size; ++k) squared[k] = std::sqrt(squared[k]);
    return squared;
  }

  /// Over the step prepared for, plus a ball of the amplitude `unsure`: the least ellipsoid by its trace.
  SPRING_WORKBENCH_INLINE void carry(const Collocation& collocation, RunError& run) {
    if (h_ != collocation.h()) {
      for (int m = 0; m < 2 * n; ++m) transition_.col(m) = collocation.carried(Collocation::Modes::Unit(m));
      h_ = collocation.h();
    }
    Moments moments = transition_ * Moments(run.spread) * transition_.transpose();
    const double size = std::sqrt(std::max(0.0, mass_.dot(moments.diagonal().template head<n>())) /
                                  mass_.dot(ball_.diagonal().template head<n>()));
    if (size > 0.0) moments *= 1.0 + run.unsure / size;
    run.spread = moments + run.unsure * (run.unsure + size) * ball_;
  }

 private:
  using Square = typename Collocation::Square;
  using Moments = Eigen::Matrix<double, 2 * n, 2 * n>;

  typename Collocation::Strain swing_rates_, mass_;
  Square to_undamped_;
  Moments ball_;        ///< of deviations of amplitude 1
  Moments transition_;  ///< over a step of h_
  double h_ = 0.0;      ///< [s]
};

}  // namespace spring_workbench::dynamics
