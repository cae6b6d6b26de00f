#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "spring_workbench/exponential/collocation.h"
#include "spring_workbench/exponential/linear_part.h"
#include "spring_workbench/exponential/modal_operators.h"
#include "spring_workbench/exponential/mode_norm.h"
#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::exponential {

/// Variation of constants over a step: the modes of a LinearPart of `n` coordinates under the collocation polynomial of
/// the residual (Collocation). Lane i of a pack belongs to node i, or to sample i.
template <int n, typename ModalDecomposition>
class ExponentialCollocation {
 public:
  using Part = LinearPart<n, ModalDecomposition>;
  using Strain = typename Part::Strain;
  using Modes = typename Part::Modes;
  using Square = typename Part::Square;
  using NodeModes = typename Part::NodeModes;
  using NodeStrains = typename Part::NodeStrains;
  static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Replaces the linear part.
  void set(const ModalDecomposition& modes) {
    part_.set(modes);
    known_.fill(false);
  }
  const Part& part() const { return part_; }
  const ModalDecomposition& modes() const { return part_.modes(); }

  /// Takes the operators for steps of `h` [s]; computes them if they are not among those of the last lengths.
  void prepare(double h) {
    const auto is_same = [h](double length) { return std::abs(h - length) <= same_length * h; };
    if (known_[now_] && is_same(lengths_[now_])) return;
    const auto found = std::find_if(lengths_.begin(), lengths_.end(), is_same);
    if (found != lengths_.end()) {
      now_ = static_cast<std::size_t>(found - lengths_.begin());
    } else {
      now_ = oldest_;
      oldest_ = (oldest_ + 1) % kept;
      lengths_[now_] = h;
      known_[now_] = false;
    }
    ++revision_;
    norm_.set(lengths_[now_], modes().rates);
    if (!known_[now_]) operators_[now_].compute(lengths_[now_], modes().rates);
    known_[now_] = true;
  }
  double h() const { return lengths_[now_]; }  ///< [s] of the steps that it was prepared for last
  /// Changes whenever the operators do; what is derived from them is valid for one value only.
  long revision() const { return revision_; }

  /// Returns the norm of modes over the step.
  const ModeNorm<2 * n>& norm() const { return norm_; }
  SPRING_WORKBENCH_INLINE static Modes at_end(const NodeModes& x) {
    Modes end;
    for (int m = 0; m < 2 * n; ++m) end[m] = x[at(m)][Collocation::count - 1];
    return end;
  }

  /// Modes at the nodes, and at the samples, for the rate q̇₀ alone.
  SPRING_WORKBENCH_INLINE void begin(const Strain& q_dot, NodeModes& nodes, NodeModes& samples) const {
    const Modes rate = part_.rate_in_modes(q_dot);
    nodes = operators_[now_].constant.applied(rate);
    samples = operators_[now_].sample_constant.applied(rate);
  }
  /// Modes at the nodes under the collocation polynomial of a residual, in modes; `from`: the result of begin().
  SPRING_WORKBENCH_INLINE void drive(const NodeModes& from, const NodeModes& residual, NodeModes& x) const {
    Operators::drive(operators_[now_].node, from, residual, x);
  }
  /// Modes at the samples under the same polynomial.
  SPRING_WORKBENCH_INLINE void drive_samples(const NodeModes& from, const NodeModes& residual, NodeModes& x) const {
    Operators::drive(operators_[now_].sample, from, residual, x);
  }

  /// Effect of a defect of the residual at the samples, in modes, on the modes at the end.
  SPRING_WORKBENCH_INLINE Modes end_effect(const NodeModes& defect) const {
    const NodeModes by_samples = operators_[now_].end_defect.applied(defect);
    Modes e;
    for (int m = 0; m < 2 * n; ++m) e[m] = math::sum(by_samples[at(m)]);
    return e;
  }
  /// Effect of such a defect on the modes at the nodes.
  SPRING_WORKBENCH_INLINE NodeModes effect(const NodeModes& defect) const {
    NodeModes e;
    Operators::drive(operators_[now_].defect, NodeModes{}, defect, e);
    return e;
  }
  /// Effect of the highest degree of a defect on the modes at the end; in lane k, if the defect at sample k causes all
  /// of it. One more sample could change the defect by about as much.
  SPRING_WORKBENCH_INLINE NodeModes effect_of_highest_degree(const NodeModes& defect) const {
    const auto& row = Collocation::third_degree();
    const math::Pack third{row[0], row[1], row[2], row[3]};
    NodeModes alone;
    for (int m = 0; m < 2 * n; ++m) alone[at(m)] = math::sum(defect[at(m)] / third) * third;
    return operators_[now_].end_defect.applied(alone);
  }

  /// Carries a small deviation of strain and rate, in modes, from the start to the nodes along the linear part.
  SPRING_WORKBENCH_INLINE NodeModes carried_in_modes(const Modes& x) const {  // e^{hλ} = 1 + λ h φ₁(hλ)
    NodeModes y = operators_[now_].constant.applied(modes().rates.applied(x));
    for (int m = 0; m < 2 * n; ++m) y[at(m)] += x[m];
    return y;
  }
  /// Carries a small deviation of strain and rate to the end of the step.
  Modes carried(const Modes& deviation) const {
    return part_.deviation(at_end(carried_in_modes(part_.deviation_in_modes(deviation))));
  }
  /// Strain and rate at the end of the step under constant accelerations, one per column.
  Eigen::Matrix<double, 2 * n, n> response(const Square& acceleration) const {
    const Eigen::Matrix<double, 2 * n, n> force = part_.in_modes(acceleration);
    Eigen::Matrix<double, 2 * n, n> x;
    for (int i = 0; i < n; ++i) x.col(i) = at_end(operators_[now_].constant.applied(Modes(force.col(i))));
    return part_.deviation(x);
  }

  /// Exchanges linear part and step; the operators are recomputed from them when they are needed.
  void archive(math::StateArchive& state) {
    state(part_, lengths_, now_, oldest_);
    if (state.is_restoring()) known_.fill(false);
  }

 private:
  using Operators = ModalOperators<2 * n>;
  /// Steps whose lengths differ by a smaller fraction are equal: the difference is the rounding of times.
  static constexpr double same_length = 1e-11;

  /// Number of lengths whose operators are kept: that of whole steps, and those of the parts that steps are cut into.
  static constexpr std::size_t kept = 4;

  Part part_;
  std::array<double, kept> lengths_{};  ///< steps for which there are operators [s]; 0: none
  std::array<bool, kept> known_{};      ///< whether these have been computed
  std::size_t now_ = 0, oldest_ = 0;    ///< indices of the current step and of the length to give up next
  long revision_ = 0;
  ModeNorm<2 * n> norm_;
  std::array<Operators, kept> operators_;
};

}  // namespace spring_workbench::exponential
