#pragma once

#include <functional>
#include <memory>
#include <string>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/dynamics/settings.h"

namespace spring_workbench::dynamics {

/// What one step says of itself.
struct StepEstimate {
  /// Estimate of the step's local error (what came out less the truth) in the active coordinates.
  rod::StrainVector q_error;
  double omega_dt = 0.0;          ///< frequency of the stiffest mode [rad/s] times the step; 0: not known
  rod::StrainVector q_dot_error;  ///< the same of the strain rates [1/s]
  bool converged = true;          ///< whether an implicit method solved its equation; else the state is not to be used
};

/// One way to carry the held body's state over a step (doc/model.md, "Integrators"). An integrator may keep what it has
/// derived from the equations and the last step; it notices by HeldBody::version() when that is out of date.
/// No allocation in a step.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Order of accuracy for smooth motions.
  virtual int order() const = 0;
  /// Whether no stiffness, however large, limits the step.
  virtual bool stiffly_stable() const { return false; }
  /// What the method does with the energy of a motion: nothing but by its error; take some away (implicit methods of
  /// low order); whatever its error is, which nothing bounds (explicit ones); or it has an energy of its own, because
  /// it does not solve the equation of motion (HeldBody) but relaxes to a target. StepControl holds the first to its
  /// error, the second to its balance. Estimates of the last are of the distance from the method's own limit.
  enum class Energy { kept, dissipated, unbounded, of_its_own };
  virtual Energy energy() const { return Energy::unbounded; }
  /// Whether short steps lead to the equation of motion.
  bool solves_the_equation_of_motion() const { return energy() != Energy::of_its_own; }

  /// Carries `state` from `t` to `t + h` [s], h > 0; `handle` must cover that time.
  virtual StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                            StrainState& state) = 0;

  /// Carries a small deviation from `begin` over the step from there to `end`: as two steps of the method differ unless
  /// it knows better.
  virtual void carry(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                     const StrainState& begin, const StrainState& end, StrainState& deviation);

  /// How the state at the end of the step depends on a constant generalised force Q over the step, to first order:
  /// Δq = response.q Q, Δq̇ = response.q_dot Q. For contact.
  struct Response {
    rod::StrainMatrix q, q_dot;
  };
  /// From the implicit Euler rule unless a method knows better.
  virtual Response response(const HeldBody& body, const HandleForcing& handle, double h, const StrainState& state);

  /// The history: what it has kept of the equations and the last step, to be given back to one of the same name.
  virtual void exchange(math::StateArchive&) {}
};

std::unique_ptr<Integrator> make_integrator(IntegratorKind kind);

/// Makes an integrator that was not given its name here known under `name`: from then on settings files, parameters,
/// services and DynamicsSettings take it like one of our own. `make` is called for each object that is grasped, and
/// again when the integrator is changed; its integrators share nothing. Call it before the first simulation is made, in
/// the same order in each program that restores a state of another. Throws InputError for a name that is empty or
/// taken.
IntegratorKind register_integrator(const std::string& name, std::function<std::unique_ptr<Integrator>()> make);

}  // namespace spring_workbench::dynamics
