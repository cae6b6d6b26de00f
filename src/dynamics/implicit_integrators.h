#pragma once

#include <Eigen/LU>

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::dynamics {

/// The equation of motion about one state: `M δq̈ = −K δq − D δq̇`, geometric stiffness, loads and gyroscopic terms
/// included. The springs' and dampers' own parts enter exactly, so that no stiffness costs digits; the rest is by
/// differences.
struct LinearisedMotion {
  rod::StrainMatrix M, K, D;
  LinearisedMotion(const HeldBody& body, const HandleForcing& handle, const StrainState& state,
                   const rod::StrainVector& q_ddot);
  /// Springs and dampers alone.
  LinearisedMotion(const HeldBody& body, double t, const rod::StrainVector& q);
};

/// Solves `(M + d D + d² K) x = b`, equilibrated, for light and heavy coordinates side by side.
class ImplicitMatrix {
 public:
  ImplicitMatrix(const LinearisedMotion& motion, double d);
  rod::StrainMatrix solve(const rod::StrainMatrix& b) const;

 private:
  rod::StrainVector scale_;
  Eigen::PartialPivLU<rod::StrainMatrix> lu_;
};

/// Implicit Euler: q₁ = q + h q̇₁, q̇₁ = q̇ + h q̈(t + h, q₁, q̇₁), by Newton's method. First order, L-stable.
class ImplicitEuler final : public Integrator {
 public:
  int order() const override { return 1; }
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::dissipated; }
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override;
};

/// Rosenbrock method of order four, stiffly accurate and L-stable, without loss of order in stiff forced systems:
/// RODASP (Steinebach 1995; Hairer & Wanner, Solving Ordinary Differential Equations II, section IV.7, equation (7.25)
/// for the form used). Each step is done as two halves; against one whole it gives the error estimate.
class Rosenbrock final : public Integrator {
 public:
  int order() const override { return 4; }
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::kept; }
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override;
  Response response(const HeldBody& body, double t, double h, const StrainState& state) override;
};

}  // namespace spring_workbench::dynamics
