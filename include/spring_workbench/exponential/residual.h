#pragma once

#include "spring_workbench/exponential/collocation.h"
#include "spring_workbench/exponential/linear_part.h"

namespace spring_workbench::exponential {

/// The nonlinear residual of an `Equation` (CollocationStep) in a step that begins in (q₀, q̇₀): its acceleration
/// without the linear part.
template <int n, typename Equation>
class Residual {
 public:
  using Part = LinearPart<n, typename Equation::ModalDecomposition>;
  using Strain = typename Part::Strain;
  using NodeModes = typename Part::NodeModes;
  using NodeStrains = typename Part::NodeStrains;

  /// The arguments must outlive this object.
  Residual(const Equation& equation, const Part& part, const Strain& q0, const Strain& q_dot0)
      : equation_(equation), part_(part), q0_(q0), q_dot0_(q_dot0) {}

  /// Returns the residual at the moments of a forcing; `x`: modes of the deviation from the start at these moments.
  SPRING_WORKBENCH_INLINE NodeStrains at(const typename Equation::Forcing& forcing, const NodeModes& x) const {
    NodeStrains dq, dv, q, q_dot, r;
    part_.deviation(x, dq, dv);
    add(q0_, dq, q);
    add(q_dot0_, dv, q_dot);
    equation_.acceleration(forcing, q.data(), q_dot.data(), r.data());
    part_.add_force(dq, dv, r);
    return r;
  }

  SPRING_WORKBENCH_INLINE static void add(const Strain& start, const NodeStrains& deviation, NodeStrains& sum) {
    for (std::size_t i = 0; i < n; ++i) sum[i] = start[static_cast<int>(i)] + deviation[i];
  }

  /// Returns the defect at the samples: the residual minus the collocation polynomial through its values at the nodes.
  SPRING_WORKBENCH_INLINE static NodeStrains defect(NodeStrains at_samples, const NodeStrains& at_nodes) {
    const std::array<math::Pack, Collocation::count>& weights = Collocation::at_samples();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < Collocation::count; ++j) at_samples[i] -= weights[j] * at_nodes[i][j];
    }
    return at_samples;
  }

 private:
  const Equation& equation_;
  const Part& part_;
  const Strain &q0_, &q_dot0_;
};

}  // namespace spring_workbench::exponential
