#pragma once

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/exponential/collocation.h"

namespace spring_workbench::dynamics {

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
