#pragma once

#include <array>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::exponential {

/// The linear part of an equation of motion of `n` coordinates, frozen over a step, and the change between coordinates
/// and its modes. With y = (q − q₀, q̇ − q̇₀), the deviation from the state at the start of the step, ẏ = A y + (q̇₀, r),
/// where r = q̈ + S (q − q₀) + D (q̇ − q̇₀) is the residual. Deviations, and so their rounding errors, are no larger than
/// the change over the step.
/// `ModalDecomposition` is that of dynamics.
template <int n, typename ModalDecomposition>
class LinearPart {
 public:
  using Strain = Eigen::Matrix<double, n, 1>;
  using Modes = Eigen::Matrix<double, 2 * n, 1>;
  using Square = Eigen::Matrix<double, n, n>;
  using NodeModes = std::array<math::Pack, static_cast<std::size_t>(2 * n)>;
  using NodeStrains = std::array<math::Pack, n>;
  static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

  void set(const ModalDecomposition& modes) {
    modes_ = modes;
    take_matrices();
  }
  const ModalDecomposition& modes() const { return modes_; }
  const Square& stiffness() const { return stiffness_; }  ///< S
  const Square& damping() const { return damping_; }      ///< D

  /// Returns S q + D q̇ of the state at the start.
  SPRING_WORKBENCH_INLINE Strain force(const Strain& q, const Strain& q_dot) const {
    return stiffness_ * q + damping_ * q_dot;
  }
  /// Adds S q + D q̇ of these deviations to the acceleration, which makes it the residual.
  SPRING_WORKBENCH_INLINE void add_force(const NodeStrains& q, const NodeStrains& q_dot, NodeStrains& q_ddot) const {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) q_ddot[at(i)] += stiffness_(i, j) * q[at(j)] + damping_(i, j) * q_dot[at(j)];
    }
  }

  /// Time derivative of the modes due to the rate q̇₀.
  SPRING_WORKBENCH_INLINE Modes rate_in_modes(const Strain& q_dot) const {
    Modes rate = to_modes_.col(0) * q_dot[0];
    for (int i = 1; i < n; ++i) rate += to_modes_.col(i) * q_dot[i];
    return rate;
  }
  /// Time derivative of the modes due to residuals, one in each lane.
  SPRING_WORKBENCH_INLINE NodeModes in_modes(const NodeStrains& residual) const {
    NodeModes r;
    for (int m = 0; m < 2 * n; ++m) {
      r[at(m)] = to_modes_(m, n) * residual[0];
      for (int i = 1; i < n; ++i) r[at(m)] += to_modes_(m, n + i) * residual[at(i)];
    }
    return r;
  }
  /// Time derivative of the modes due to accelerations, one in each column.
  Eigen::Matrix<double, 2 * n, n> in_modes(const Square& acceleration) const {
    return to_modes_.template rightCols<n>() * acceleration;
  }
  /// Upper bound of that derivative for accelerations of this size.
  Modes bound_in_modes(const Strain& acceleration) const {
    return to_modes_.template rightCols<n>().cwiseAbs() * acceleration;
  }
  Modes deviation_in_modes(const Modes& deviation) const { return to_modes_ * deviation; }

  /// Strain and rate of the modes in each lane, as deviations from the start.
  SPRING_WORKBENCH_INLINE void deviation(const NodeModes& x, NodeStrains& q, NodeStrains& q_dot) const {
    for (int i = 0; i < n; ++i) {
      q[at(i)] = from_modes_(i, 0) * x[0];
      q_dot[at(i)] = from_modes_(n + i, 0) * x[0];
      for (int m = 1; m < 2 * n; ++m) {
        q[at(i)] += from_modes_(i, m) * x[at(m)];
        q_dot[at(i)] += from_modes_(n + i, m) * x[at(m)];
      }
    }
  }
  /// Strain and rate of the modes in each column.
  template <typename Columns>
  Eigen::Matrix<double, 2 * n, Columns::ColsAtCompileTime> deviation(const Eigen::MatrixBase<Columns>& x) const {
    return from_modes_ * x;
  }

  void archive(math::StateArchive& state) {
    state(modes_);
    if (state.is_restoring()) take_matrices();
  }

 private:
  void take_matrices() {  // their sizes are known at compile time from here on
    stiffness_ = modes_.stiffness;
    damping_ = modes_.damping;
    to_modes_ = modes_.to_modes;
    from_modes_ = modes_.from_modes;
  }

  ModalDecomposition modes_;
  Square stiffness_, damping_;
  Eigen::Matrix<double, 2 * n, 2 * n> to_modes_, from_modes_;
};

}  // namespace spring_workbench::exponential
