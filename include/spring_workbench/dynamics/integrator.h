#pragma once

#include <memory>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/dynamics/settings.h"

namespace spring_workbench::dynamics {

/// What one step says of itself.
struct StepEstimate {
  rod::StrainVector
      q_error;  ///< estimate of the step's local error (what came out less the truth) in the active coordinates
  double omega_dt =
      0.0;  ///< frequency of the stiffest mode [rad/s] times the step; 0 where the method does not know it
  rod::StrainVector q_dot_error = rod::StrainVector();  ///< the same of the strain rates [1/s]
};

/// One way to carry the held body's state over a step (doc/model.md, "Integrators"). An integrator may keep what it has
/// derived from the equations and the last step; it notices by HeldBody::version() when that is out of date.
/// No allocation in a step.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Order of accuracy for smooth motions.
  virtual int order() const = 0;
  /// Whether no stiffness, however large, limits the step: what StepControl guards.
  virtual bool stiffly_stable() const { return false; }
  /// Whether the estimate holds, too, in a step that begins with a jump of the handle's acceleration.
  virtual bool estimates_after_jumps() const { return true; }

  /// Carries `state` from `t` to `t + h` [s], h > 0; `handle` must cover that time.
  virtual StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                            StrainState& state) = 0;

  /// How the state at the end of the step depends on a constant generalised force Q over the step, to first order:
  /// Δq = response.q Q, Δq̇ = response.q_dot Q. For contact.
  struct Response {
    rod::StrainMatrix q, q_dot;
  };
  /// From the implicit Euler rule unless a method knows better.
  virtual Response response(const HeldBody& body, double t, double h, const StrainState& state);

  /// The history: what it has kept of the equations and the last step, to be given back to one of the same name.
  virtual void exchange(math::StateArchive&) {}
};

std::unique_ptr<Integrator> make_integrator(IntegratorKind kind);

}  // namespace spring_workbench::dynamics
