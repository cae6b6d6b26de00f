#pragma once

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::dynamics {

/// Semi-implicit Euler: q̇ += h q̈(q, q̇), q += h q̇. First order; unstable for ω h > 2, with damping for less.
class SemiImplicitEuler final : public Integrator {
 public:
  int order() const override { return 1; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override;
  void propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                           const StrainState& begin, const StrainState& end, StrainState& deviation) override;
};

/// The classical Runge–Kutta method of order four. Unstable for ω h > 2.8.
class RungeKutta4 final : public Integrator {
 public:
  int order() const override { return 4; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override;
  void propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                           const StrainState& begin, const StrainState& end, StrainState& deviation) override;
};

}  // namespace spring_workbench::dynamics
