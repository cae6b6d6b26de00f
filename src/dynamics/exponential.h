#pragma once

#include <memory>

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::dynamics {

/// Exponential collocation. The coupled linear part, frozen near a recent state, is solved in closed form through its
/// modes (exponential/linear_part.h); the nonlinear residual of the acceleration is approximated by the collocation
/// polynomial through its values at four Radau nodes of the step (exponential/exponential_collocation.h). These come
/// from a fixed-point iteration with Anderson acceleration (exponential/anderson_mixer.h) that starts from the last
/// step's polynomial (exponential/extrapolation.h) and ends when further iterations would change a fraction of the
/// collocation error (exponential/convergence.h). If it does not converge, the linear part is recomputed at the start
/// of the step, once. It is also recomputed when that pays (exponential/refactorisation.h). Order seven if the step
/// resolves every mode, otherwise five; exact for linear systems under a handle whose acceleration is a cubic in time;
/// no stiffness limits the step. The estimate of the local error is the sampled defect of the step's own interpolant.
class Exponential final : public Integrator {
 public:
  Exponential();
  ~Exponential() override;

  int order() const override { return 5; }  // of a mode that the step does not resolve; otherwise more
  bool stiffly_stable() const override { return true; }
  Energy energy() const override { return Energy::conserved; }
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override;
  void propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                           const StrainState& begin, const StrainState& end, StrainState& deviation) override;
  bool tracks_run_error() const override { return true; }
  void propagate_run_error(const HeldBody& body, RunError& error) override;
  std::optional<StepWork> work(const HeldBody& body) const override;
  Response response(const HeldBody& body, const HandleState& handle, double h, const StrainState& state) override;
  void archive(math::StateArchive& state) override;
  bool restores_completely() const override { return true; }

 private:
  class Core;  ///< for one number of coordinates
  template <int n>
  class CoreOf;
  Core& core(int n);

  std::unique_ptr<Core> core_;  ///< replaced when the number of coordinates changes
  int n_ = 0;
};

}  // namespace spring_workbench::dynamics
