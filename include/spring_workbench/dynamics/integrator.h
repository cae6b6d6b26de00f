#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/dynamics/settings.h"

namespace spring_workbench::dynamics {

/// Error estimate of one step.
struct StepEstimate {
  /// Estimate of the step's local error (result minus exact solution) in the active coordinates.
  rod::StrainVector q_error;
  double omega_dt = 0.0;          ///< frequency of the stiffest mode [rad/s] times the step; 0: not known
  rod::StrainVector q_dot_error;  ///< estimate of the step's local error in the rates of these coordinates
  bool converged = true;  ///< whether an implicit method solved its equation; if false, the state must not be used
};

/// Estimate of the error of a run (the state minus the exact solution of the equation of motion), with its uncertainty.
/// Bounds that follow from it are empirical estimates from above, not rigorous (doc/model.md, "Error bound").
struct RunError {
  /// Symmetric matrix of the active coordinates and their rates.
  using Spread = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * rod::max_strain_coordinates,
                               2 * rod::max_strain_coordinates>;
  StrainState estimate;  ///< estimated error of coordinates and rates
  /// Ellipsoid about the estimate within which the error is expected: e = (strain, rate) of the error minus the
  /// estimate fulfils eᵀ spread⁻¹ e ≤ 1. Positive semi-definite.
  Spread spread;
  double uncertainty = 0.0;  ///< largest difference of the last step's error from its estimate, as an amplitude [m √kg]
};

/// EnergyBalance along the path of a step.
struct StepWork {
  double energy_at_end = 0.0;  ///< energy at the end of the step [J]
  double work = 0.0;           ///< work done over the step by all that changes the energy [J]
};

/// Integrates the held body's equation of motion over a step (doc/model.md, "Integrators"). An integrator may keep what
/// it has derived from the equations and the last step while HeldBody::version() stays the same. step() must not
/// allocate memory. Not thread-safe; each held object has its own. examples/02_own_integrator implements one.
class Integrator {
 public:
  virtual ~Integrator() = default;

  virtual int order() const = 0;                         ///< order of accuracy for smooth motions
  virtual bool stiffly_stable() const { return false; }  ///< whether the step is stable at any stiffness
  /// Effect of the method on the energy of a motion: conserved up to its error; partly dissipated (implicit methods of
  /// low order); unbounded (explicit methods); or not applicable, if the method relaxes to a target instead of solving
  /// the equation of motion. StepControl bounds the energy error of the first and the energy gain of the second. The
  /// error estimates of the last refer to the method's own limit for short steps.
  enum class Energy { conserved, dissipated, unbounded, not_applicable };
  virtual Energy energy() const { return Energy::unbounded; }  ///< the effect of this method
  /// Whether short steps lead to the equation of motion.
  bool solves_the_equation_of_motion() const { return energy() != Energy::not_applicable; }

  /// Replaces `state` at time `t` by the state at `t + h` [s], h > 0; `handle` must cover that time. Returns an
  /// estimate of the local error; set `converged = false` to have the step repeated as shorter ones.
  virtual StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                            StrainState& state) = 0;

  /// Replaces `deviation`, a small change of the state `begin` at time `t` [s], by the change of the state `end` at
  /// `t + h` that it causes: by default the difference of two steps of the method.
  virtual void propagate_deviation(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                                   const StrainState& begin, const StrainState& end, StrainState& deviation);

  /// Whether the method has an interpolant whose defect it samples, so that it can track the error of a run.
  virtual bool tracks_run_error() const { return false; }
  /// Propagates `error` over the last step and adds that step's own error. Called after step(), for accepted steps
  /// only, in their order, with the same body.
  virtual void propagate_run_error([[maybe_unused]] const HeldBody& body, [[maybe_unused]] RunError& error) {}
  /// The work over the last step along the method's own path; nothing if it has no more than the step's ends.
  virtual std::optional<StepWork> work(const HeldBody&) const { return std::nullopt; }

  /// How the state at the end of the step depends on a constant generalised force Q over the step, to first order:
  /// Δq = response.q Q, Δq̇ = response.q_dot Q. For contact.
  struct Response {
    rod::StrainMatrix q;      ///< Δq per unit of Q
    rod::StrainMatrix q_dot;  ///< Δq̇ per unit of Q
  };
  /// Returns the response of a step of `h` [s] from `state`: by default that of the implicit Euler rule.
  virtual Response response(const HeldBody& body, const HandleForcing& handle, double h, const StrainState& state);

  /// Saves or restores the history: override it to call `state(a_, b_, …)` with every member that step() keeps.
  virtual void exchange(math::StateArchive&) {}
  /// Whether restoring a history overwrites all that it keeps, so that one integrator can serve several runs in turn.
  virtual bool restores_completely() const { return false; }
};

/// Makes an integrator, built in or registered, without history.
std::unique_ptr<Integrator> make_integrator(IntegratorKind kind);

/// Swaps two integrators if both are of the same class and that class restores all, so that each can take the other's
/// place.
void swap_alike(std::unique_ptr<Integrator>& a, std::unique_ptr<Integrator>& b);

/// Registers an integrator of your own under `name`: from then on settings files, parameters, services and
/// DynamicsSettings accept it like a built-in one. `make` is called for each object that is grasped, and again when the
/// integrator is changed; the integrators that it makes share nothing. Call it before the first simulation is made, in
/// the same order in every program that restores a state saved by another one. Throws InputError for a name that is
/// empty or taken.
IntegratorKind register_integrator(const std::string& name, std::function<std::unique_ptr<Integrator>()> make);

}  // namespace spring_workbench::dynamics
