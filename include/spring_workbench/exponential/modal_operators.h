#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "spring_workbench/exponential/collocation.h"
#include "spring_workbench/exponential/general_complex.h"

namespace spring_workbench::exponential {

/// Four functions of a linear part, one in each lane, in the coordinates of its modes: a number for a single mode, a
/// 2 × 2 block for a pair (RealModes), so that x ↦ own x + other x', where x' is x with the members of each pair
/// exchanged.
template <int modes>
struct ModalOperator {
  using Packs = std::array<math::Pack, static_cast<std::size_t>(modes)>;
  static constexpr std::size_t at(int m) { return static_cast<std::size_t>(m); }

  Packs own{}, other{};

  /// Row `m` of the functions, applied to modes that are the same for all lanes.
  template <typename Modes>
  SPRING_WORKBENCH_INLINE math::Pack apply(int m, const Modes& x) const {
    return own[at(m)] * x[m] + other[at(m)] * x[m ^ 1];
  }
  /// The same applied to modes of their own in each lane.
  SPRING_WORKBENCH_INLINE math::Pack apply(int m, const Packs& x) const {
    return own[at(m)] * x[at(m)] + other[at(m)] * x[at(m ^ 1)];
  }
  void set(std::size_t lane, int m, double value) {
    own[at(m)][lane] = value;
    other[at(m)][lane] = 0.0;
  }
  void set(std::size_t lane, int m, const GeneralComplex& value) {
    own[at(m)][lane] = own[at(m + 1)][lane] = value.re;
    other[at(m)][lane] = value.im;
    other[at(m + 1)][lane] = value.square * value.im;
  }
};

/// The functions of a linear part that a step needs (Collocation::Weights), times the step.
/// Lane i belongs to node i of Collocation, or to sample i.
template <int modes>
struct ModalOperators {
  static constexpr std::size_t count = Collocation::count;
  using Operator = ModalOperator<modes>;
  using Packs = typename Operator::Packs;
  using PerNode = std::array<Operator, count>;

  Operator constant, sample_constant;  ///< of a constant derivative: at the nodes, at the samples
  PerNode node, sample;                ///< of the residual at each node: at the nodes, at the samples
  PerNode defect;                      ///< of the residual's defect at each sample, at the nodes
  Operator end_defect;                 ///< of the defect at the sample of each lane, at the end

  /// Computes all for steps of `h` [s] and the first `modes` of `rates` [1/s], of which 2 `pairs` form pairs.
  template <typename Rates>
  void compute(double h, const Rates& rates, int pairs) {
    for (int m = 0; m < 2 * pairs; m += 2) set(h, m, Collocation::weights(h * rates[Operator::at(m)]));
    for (int m = 2 * pairs; m < modes; ++m) set(h, m, Collocation::weights(h * rates[Operator::at(m)].re));
  }

  /// x = from + Σ_j by[j] residual_j, where residual_j is lane j of the residual.
  SPRING_WORKBENCH_INLINE static void drive(const PerNode& by, const Packs& from, const Packs& residual, Packs& x) {
    for (int m = 0; m < modes; ++m) {
      const math::Pack own = residual[Operator::at(m)], other = residual[Operator::at(m ^ 1)];
      math::Pack sum = from[Operator::at(m)];
      for (std::size_t j = 0; j < count; ++j) {
        sum += by[j].own[Operator::at(m)] * own[j] + by[j].other[Operator::at(m)] * other[j];
      }
      x[Operator::at(m)] = sum;
    }
  }

 private:
  template <typename Weights>
  void set(double h, int m, const Weights& w) {
    for (std::size_t i = 0; i < count; ++i) {
      constant.set(i, m, h * w.constant[i]);
      sample_constant.set(i, m, h * w.sample_constant[i]);
      for (std::size_t j = 0; j < count; ++j) {
        node[j].set(i, m, h * w.node[i][j]);
        sample[j].set(i, m, h * w.sample[i][j]);
        defect[j].set(i, m, h * w.defect[i][j]);
        if (i + 1 == count) end_defect.set(j, m, h * w.defect[i][j]);
      }
    }
  }
};

}  // namespace spring_workbench::exponential
