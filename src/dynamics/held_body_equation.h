#pragma once

#include <algorithm>

#include "modal_decomposition.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/exponential/collocation.h"
#include "spring_workbench/math/spatial.h"

namespace spring_workbench::dynamics {

/// The equation of motion of a held body in `n` active coordinates as exponential::CollocationStep takes it.
template <int n>
class HeldBodyEquation {
 public:
  using ModalDecomposition = dynamics::ModalDecomposition;
  using Input = motion::Trajectory;  ///< of the handle
  using Forcing = HandleStates;
  using Strain = Eigen::Matrix<double, n, 1>;
  using NodeStrains = std::array<math::Pack, n>;

  explicit HeldBodyEquation(const HeldBody& body) : body_(body) {}

  HandleStates forcing(const Input& handle, const math::Pack& t) const { return body_.state_at(handle, t); }
  SPRING_WORKBENCH_INLINE void acceleration(const HandleStates& forcing, const math::Pack* q, const math::Pack* q_dot,
                                            math::Pack* q_ddot) const {
    body_.template acceleration<n>(forcing, q, q_dot, q_ddot);
  }
  Strain acceleration(const Input& handle, double t, const Strain& q, const Strain& q_dot) const {
    return body_.template acceleration<n>(body_.state_at(handle, t), q, q_dot);
  }

  /// The acceleration by the handle's acceleration and the external wrench alone.
  SPRING_WORKBENCH_INLINE NodeStrains by_forcing(const HandleStates& forcing, const ModalDecomposition& modes) const {
    const motion::BodyFrameRates<math::Pack>& handle = forcing.of_H;
    const Wrench& load = body_.load();
    const auto force = math::transposed(handle.R_WB, math::vec3(load.force)),
               moment = math::transposed(handle.R_WB, math::vec3(load.moment));
    const auto& A = modes.by_handle;
    const auto& B = modes.by_wrench;
    NodeStrains a;
    for (int row = 0; row < n; ++row) {
      const auto i = static_cast<std::size_t>(row);
      a[i] = A(row, 0) * handle.a_B.x + A(row, 1) * handle.a_B.y + A(row, 2) * handle.a_B.z +
             A(row, 3) * handle.alpha_B.x + A(row, 4) * handle.alpha_B.y + A(row, 5) * handle.alpha_B.z;
      a[i] += B(row, 0) * force.x + B(row, 1) * force.y + B(row, 2) * force.z + B(row, 3) * moment.x +
              B(row, 4) * moment.y + B(row, 5) * moment.z;
    }
    return a;
  }

  /// Squared size of the rounding errors of a state over those of 1. Couplings add theirs: their strains are
  /// differences of positions as far from the origin as their frames, and the step responds to a part of them.
  double squared_rounding(const HandleStates& forcing, const ModalDecomposition& modes, double h, const Strain& q,
                          const Strain& q_dot) const {
    const double felt = forcing.relative_motions.distance * std::min(1.0, modes.fastest * h * modes.fastest * h);
    return modes.mass.dot(rod::StrainVector(q.cwiseAbs2() + h * h * q_dot.cwiseAbs2())) +
           body_.body().mass * felt * felt;
  }
  /// Springs, dampers and loads may cancel: the acceleration is then a small difference of large terms.
  template <typename LinearPart>
  Strain cancelling(const LinearPart& part, const Strain& q, const Strain& q_dot) const {
    const Wrench& load = body_.load();
    const Wrench all{Vector3d::Constant(load.force.norm()), Vector3d::Constant(load.moment.norm())};
    return part.stiffness().cwiseAbs() * q.cwiseAbs() + part.damping().cwiseAbs() * q_dot.cwiseAbs() +
           part.modes().by_wrench.cwiseAbs() * to_vector(all);
  }

 private:
  const HeldBody& body_;
};

/// The work over the last of these `steps` of exponential collocation, by Radau's quadrature at its nodes.
template <typename Steps>
StepWork work_of(const HeldBody& body, const Steps& steps) {
  using exponential::Collocation;
  typename Steps::NodeStrains q, q_dot;
  steps.path(q, q_dot);
  const EnergyBalance at_nodes = body.energy_balance(steps.done().forcing, q.data(), q_dot.data());
  double power = 0.0;
  for (std::size_t i = 0; i < Collocation::count; ++i) {
    power += Collocation::quadrature[i] * at_nodes.power[static_cast<int>(i)];
  }
  return {at_nodes.energy[Collocation::count - 1], steps.propagator().h() * power};
}

}  // namespace spring_workbench::dynamics
