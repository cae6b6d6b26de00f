#pragma once

#include <optional>

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/dynamics/linearised_motion.h"

namespace spring_workbench::dynamics {

/// Implicit Euler: q₁ = q + h q̇₁, q̇₁ = q̇ + h q̈(t + h, q₁, q̇₁), by Newton's method. First order, L-stable.
class ImplicitEuler final : public Integrator {
 public:
  int order() const override { return 1; }
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::dissipated; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override;
  void propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                           const StrainState& begin, const StrainState& end, StrainState& deviation) override;

 private:
  std::optional<LinearisedMotion> last_;  ///< of the last step
};

/// Rosenbrock method of order four, stiffly accurate and L-stable, without loss of order in stiff forced systems:
/// RODASP (Steinebach 1995; Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.7, equation (7.25)
/// for the form used). Each step is taken as two halves; their difference from one whole step gives the error estimate.
class Rosenbrock final : public Integrator {
 public:
  int order() const override { return 4; }
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::conserved; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override;
  void propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                           const StrainState& begin, const StrainState& end, StrainState& deviation) override;
  Response response(const HeldBody& body, const HandleState& handle, double h, const StrainState& state) override;

 private:
  std::optional<LinearisedMotion> last_;  ///< of the last step
};

}  // namespace spring_workbench::dynamics
