#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "spring_workbench/math/collocation.h"
#include "spring_workbench/math/general_complex.h"
#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::math {

/// Variation of constants for the linear part of `n` coordinates over a step, as deviations from the state at its
/// start: with y = (q − q₀, q̇ − q̇₀), ẏ = A y + (q̇₀, r), where the residual r = q̈ + S (q − q₀) + D (q̇ − q̇₀) is the
/// cubic through its values at the nodes of Collocation. Taken from the start, y is no larger than what the step
/// changes, and so is its rounding.
/// Lane i of a pack belongs to node i, or to sample i. The linear part comes as `ModalDecomposition` (of dynamics).
template <int n, typename ModalDecomposition>
class ExponentialCollocation {
 public:
  using Strain = Eigen::Matrix<double, n, 1>;
  using Modes = Eigen::Matrix<double, 2 * n, 1>;
  using Square = Eigen::Matrix<double, n, n>;
  using NodeModes = std::array<Pack, static_cast<std::size_t>(2 * n)>;
  using NodeStrains = std::array<Pack, n>;

  /// Takes another linear part.
  void set(const ModalDecomposition& modes) {
    modes_ = modes;
    stiffness_ = modes.stiffness;
    damping_ = modes.damping;
    to_modes_ = modes.to_modes;
    from_modes_ = modes.from_modes;
    h_ = 0.0;
  }
  const ModalDecomposition& modes() const { return modes_; }
  double h() const { return h_; }  ///< prepared for [s]; 0: none
  const Square& stiffness() const { return stiffness_; }
  const Square& damping() const { return damping_; }

  /// Makes the operators for steps of `h` [s].
  void prepare(double h) {
    if (std::abs(h - h_) <= same_length * h) return;
    h_ = h;
    for (int m = 0; m < 2 * n; ++m) {
      const double weight = 1.0 / std::max(1.0 / h, abs(modes_.rates[at(m)]));
      squared_weight_[m] = weight * weight;
    }
    const auto take = [this, h](int m, const auto& w) {
      for (std::size_t i = 0; i < count; ++i) {
        set(constant_, i, m, h * w.constant[i]);
        set(sample_constant_, i, m, h * w.sample_constant[i]);
        for (std::size_t j = 0; j < count; ++j) {
          set(node_[j], i, m, h * w.node[i][j]);
          set(sample_[j], i, m, h * w.sample[i][j]);
          set(defect_[j], i, m, h * w.defect[i][j]);
          if (i + 1 == count) set(end_defect_, j, m, h * w.defect[i][j]);
        }
      }
    };
    for (int m = 0; m < 2 * modes_.pairs; m += 2) take(m, Collocation::weights(h * modes_.rates[at(m)]));
    for (int m = 2 * modes_.pairs; m < 2 * n; ++m) take(m, Collocation::weights(h * modes_.rates[at(m)].re));
  }

  /// Squared weights of the modes: a displacement counts as it is, a velocity times what is left of it over the step.
  const Modes& squared_weight() const { return squared_weight_; }
  SPRING_WORKBENCH_INLINE double squared_size(const Modes& x) const { return squared_weight_.dot(x.cwiseAbs2()); }
  SPRING_WORKBENCH_INLINE static Modes at_end(const NodeModes& x) {
    Modes end;
    for (int m = 0; m < 2 * n; ++m) end[m] = x[at(m)][count - 1];
    return end;
  }
  /// The squared size, at most, of what terms of this size in the acceleration change in a step.
  double squared_effect(const Strain& accelerations) const {
    const Modes rates = to_modes_.template rightCols<n>().cwiseAbs() * accelerations;
    return squared_size(rates.cwiseProduct(squared_weight_.cwiseSqrt()));
  }

  /// The modes at the nodes from the rate at the start alone, and at the samples.
  SPRING_WORKBENCH_INLINE void begin(const Strain& q_dot, NodeModes& nodes, NodeModes& samples) const {
    Modes rate = to_modes_.col(0) * q_dot[0];
    for (int i = 1; i < n; ++i) rate += to_modes_.col(i) * q_dot[i];
    for (int m = 0; m < 2 * n; ++m) {
      nodes[at(m)] = constant_.own[at(m)] * rate[m] + constant_.other[at(m)] * rate[m ^ 1];
      samples[at(m)] = sample_constant_.own[at(m)] * rate[m] + sample_constant_.other[at(m)] * rate[m ^ 1];
    }
  }
  SPRING_WORKBENCH_INLINE NodeModes in_modes(const NodeStrains& residual) const {
    NodeModes r;
    for (int m = 0; m < 2 * n; ++m) {
      r[at(m)] = to_modes_(m, n) * residual[0];
      for (int i = 1; i < n; ++i) r[at(m)] += to_modes_(m, n + i) * residual[at(i)];
    }
    return r;
  }
  /// The modes at the nodes under the cubic through the residual, `from` begin().
  SPRING_WORKBENCH_INLINE void drive(const NodeModes& from, const NodeModes& residual, NodeModes& x) const {
    drive(node_, from, residual, x);
  }
  SPRING_WORKBENCH_INLINE void drive_samples(const NodeModes& from, const NodeModes& residual, NodeModes& x) const {
    drive(sample_, from, residual, x);
  }
  /// Strain and rate, as deviations from the start.
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
  Modes deviation(const Modes& x) const { return from_modes_ * x; }
  Modes in_modes(const Modes& deviation) const { return to_modes_ * deviation; }
  /// What the linear part gives of the acceleration at these deviations is taken off: q̈ becomes the residual.
  SPRING_WORKBENCH_INLINE void take_linear_part(const NodeStrains& q, const NodeStrains& q_dot,
                                                NodeStrains& q_ddot) const {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) q_ddot[at(i)] += stiffness_(i, j) * q[at(j)] + damping_(i, j) * q_dot[at(j)];
    }
  }
  /// What a defect of the residual at the samples, in modes, does to the modes at the end.
  SPRING_WORKBENCH_INLINE Modes end_effect(const NodeModes& defect) const {
    Modes e;
    for (int m = 0; m < 2 * n; ++m) {
      e[m] = sum(end_defect_.own[at(m)] * defect[at(m)] + end_defect_.other[at(m)] * defect[at(m ^ 1)]);
    }
    return e;
  }
  /// The same at the nodes.
  SPRING_WORKBENCH_INLINE NodeModes effect(const NodeModes& defect) const {
    NodeModes e;
    drive(defect_, NodeModes{}, defect, e);
    return e;
  }
  /// What the highest degree of a defect does to the modes at the end, lane k if it is one of sample k alone: as much
  /// as a defect with one sample more might be another one.
  SPRING_WORKBENCH_INLINE NodeModes effect_of_highest_degree(const NodeModes& defect) const {
    const auto& row = Collocation::third_degree();
    const Pack third{row[0], row[1], row[2], row[3]};
    NodeModes alone, e;
    for (int m = 0; m < 2 * n; ++m) alone[at(m)] = sum(defect[at(m)] / third) * third;
    for (int m = 0; m < 2 * n; ++m) {
      e[at(m)] = end_defect_.own[at(m)] * alone[at(m)] + end_defect_.other[at(m)] * alone[at(m ^ 1)];
    }
    return e;
  }
  /// A small deviation at the start of the step prepared for, in modes, at the nodes.
  SPRING_WORKBENCH_INLINE NodeModes carried_in_modes(const Modes& x) const {  // e^{hλ} = 1 + λ h φ₁(hλ)
    Modes rate;
    for (int m = 0; m < 2 * n; ++m) {
      const GeneralComplex& z = modes_.rates[at(m)];
      rate[m] = z.re * x[m] + (m % 2 == 0 ? 1.0 : z.square) * z.im * x[m ^ 1];
    }
    NodeModes y;
    for (int m = 0; m < 2 * n; ++m) {
      y[at(m)] = x[m] + constant_.own[at(m)] * rate[m] + constant_.other[at(m)] * rate[m ^ 1];
    }
    return y;
  }
  /// The same of strain and rate, at the end.
  Modes carried(const Modes& deviation) const { return from_modes_ * at_end(carried_in_modes(in_modes(deviation))); }
  /// Strain and rate at the end of the step for constant accelerations, a column each.
  Eigen::Matrix<double, 2 * n, n> response(const Square& acceleration) const {
    const Eigen::Matrix<double, 2 * n, n> force = to_modes_.template rightCols<n>() * acceleration;
    Eigen::Matrix<double, 2 * n, n> x;
    for (int m = 0; m < 2 * n; ++m) {
      x.row(m) = constant_.own[at(m)][count - 1] * force.row(m) + constant_.other[at(m)][count - 1] * force.row(m ^ 1);
    }
    return from_modes_ * x;
  }

  static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// The operators are made again from the linear part and the step.
  void exchange(StateArchive& state) {
    double h = h_;
    state(modes_, h);
    if (!state.sets()) return;
    set(ModalDecomposition(modes_));
    if (h > 0.0) prepare(h);
  }

 private:
  static constexpr std::size_t count = Collocation::count;
  /// Steps whose lengths differ by less are equal: what differs is the rounding of times.
  static constexpr double same_length = 1e-11;

  /// A function of the linear part, in modes: x ↦ own x + other x with the members of each pair exchanged.
  struct Operator {
    NodeModes own{}, other{};
  };
  static void set(Operator& o, std::size_t lane, int m, double value) {
    o.own[at(m)][lane] = value;
    o.other[at(m)][lane] = 0.0;
  }
  static void set(Operator& o, std::size_t lane, int m, const GeneralComplex& value) {
    o.own[at(m)][lane] = o.own[at(m + 1)][lane] = value.re;
    o.other[at(m)][lane] = value.im;
    o.other[at(m + 1)][lane] = value.square * value.im;
  }
  SPRING_WORKBENCH_INLINE static void drive(const std::array<Operator, count>& by, const NodeModes& from,
                                            const NodeModes& residual, NodeModes& x) {
    for (int m = 0; m < 2 * n; ++m) {
      const Pack own = residual[at(m)], other = residual[at(m ^ 1)];
      Pack sum = from[at(m)];
      for (std::size_t j = 0; j < count; ++j) sum += by[j].own[at(m)] * own[j] + by[j].other[at(m)] * other[j];
      x[at(m)] = sum;
    }
  }

  ModalDecomposition modes_;
  Square stiffness_, damping_;
  Eigen::Matrix<double, 2 * n, 2 * n> to_modes_, from_modes_;
  double h_ = 0.0;  ///< what the operators are for
  Modes squared_weight_ = Modes::Zero();
  Operator constant_, sample_constant_;
  std::array<Operator, count> node_{}, sample_{};  ///< of the residual at each node
  std::array<Operator, count> defect_{};           ///< of its defect at each sample
  Operator end_defect_;                            ///< of that at each sample, lane by lane, to the end
};

}  // namespace spring_workbench::math
