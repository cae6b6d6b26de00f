#pragma once

#include <memory>

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::dynamics {

/// Exponential collocation: the coupled linear part, frozen near a recent state, in closed form through its modes, with
/// what it leaves over as the cubic through four Lobatto nodes of the step (collocation.h), found by sweeps that start
/// from the last step's cubic and go on by Anderson's acceleration of depth two (Walker and Ni, SIAM J. Numer. Anal.
/// 49, 2011). Order five, or six where the sweeps' error does not show; exact for linear systems whose handle
/// accelerates as a cubic of time; no stiffness limits its step. Where the sweeps do not converge, the linear part is
/// taken anew, then the step is halved.
class Exponential final : public Integrator {
 public:
  Exponential();
  ~Exponential() override;

  int order() const override { return 5; }
  bool stiffly_stable() const override { return true; }
  bool estimates_after_jumps() const override { return false; }  // the cubic's differences do not see what it misses
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override;
  Response response(const HeldBody& body, double t, double h, const StrainState& state) override;
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
