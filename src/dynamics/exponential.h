#pragma once

#include <memory>

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::dynamics {

/// Exponential collocation: the coupled linear part, frozen near a recent state, in closed form through its modes
/// (math/exponential_collocation.h), with what it leaves of the acceleration, the residual, as the cubic through four
/// Radau nodes of the step. The residual is found by fixed-point iteration with Anderson's acceleration
/// (math/anderson_mixer.h) from the last step's, to a fiftieth of what the cubic misses, as the rate of convergence
/// says (Hairer and Wanner II, IV.8, equation (8.10)). Order seven where the step resolves every mode, five where it
/// does not; exact for linear systems whose handle accelerates as a cubic of time; no stiffness limits its step. The
/// estimate of the local error is the defect of the step's own interpolant, sampled. Where the iteration does not
/// converge, the linear part is taken at the step's start, once; then the step is not solved.
class Exponential final : public Integrator {
 public:
  Exponential();
  ~Exponential() override;

  int order() const override { return 5; }  // at least: of a mode that the step does not resolve
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::kept; }
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override;
  void carry(const HeldBody& body, const motion::FrameMotion& handle, double t, double h, const StrainState& begin,
             const StrainState& end, StrainState& deviation) override;
  bool follows_errors() const override { return true; }
  void follow(const HeldBody& body, RunError& error) override;
  Response response(const HeldBody& body, const HandleForcing& handle, double h, const StrainState& state) override;
  void exchange(math::StateArchive& state) override;

 private:
  class Core;  ///< for one number of coordinates
  template <int n>
  class CoreOf;
  Core& core(int n);

  std::unique_ptr<Core> core_;  ///< made anew when the number of coordinates changes
  int n_ = 0;
};

}  // namespace spring_workbench::dynamics
