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
  rod::StrainVector q_dot_error;  ///< the same of the strain rates [1/s]
  bool converged = true;  ///< whether an implicit method solved its equation; if false, the state must not be used
};

/// Estimate of the error of a run, and a bound on it: the state minus the exact solution of the equation of motion.
struct RunError {
  using Moments = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * rod::max_strain_coordinates,
                                2 * rod::max_strain_coordinates>;
  StrainState estimate;
  /// Ellipsoid about the estimate that contains the error: e = (strain, rate) of the error minus the estimate fulfils
  /// eᵀ spread⁻¹ e ≤ 1. Positive semi-definite.
  Moments spread;
  double uncertainty = 0.0;  ///< largest difference of the last step's error from its estimate, as an amplitude [m √kg]
};

/// Energy at the end of a step [J], and the work done over it [J] by all that changes the energy: EnergyBalance along
/// the path of the step.
struct StepWork {
  double energy_at_end = 0.0, work = 0.0;
};

/// Integrates the held body's equation of motion over a step (doc/model.md, "Integrators"). An integrator may keep what
/// it has derived from the equations and the last step while HeldBody::version() stays the same. It allocates no memory
/// in a step.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Order of accuracy for smooth motions.
  virtual int order() const = 0;
  /// Whether the step is stable at any stiffness.
  virtual bool stiffly_stable() const { return false; }
  /// Effect of the method on the energy of a motion: conserved up to its error; partly dissipated (implicit methods of
  /// low order); unbounded (explicit methods); or not applicable, if the method relaxes to a target instead of solving
  /// the equation of motion. StepControl bounds the energy error of the first and the energy gain of the second. The
  /// error estimates of the last refer to the method's own limit for short steps.
  enum class Energy { conserved, dissipated, unbounded, not_applicable };
  virtual Energy energy() const { return Energy::unbounded; }
  /// Whether short steps lead to the equation of motion.
  bool solves_the_equation_of_motion() const { return energy() != Energy::not_applicable; }

  /// Carries `state` from `t` to `t + h` [s], h > 0; `handle` must cover that time.
  virtual StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                            StrainState& state) = 0;

  /// Carries a small deviation from `begin` over the step from there to `end`: by default the difference of two steps
  /// of the method.
  virtual void carry(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                     const StrainState& begin, const StrainState& end, StrainState& deviation);

  /// Whether the method has an interpolant whose defect it samples, so that it can track the error of a run.
  virtual bool follows_errors() const { return false; }
  /// Propagates the run's error over the last step, and adds that step's own error.
  virtual void follow(const HeldBody&, RunError&) {}
  /// The work over the last step along the method's own path; nothing if it has no more than the step's ends.
  virtual std::optional<StepWork> work(const HeldBody&) const { return std::nullopt; }

  /// How the state at the end of the step depends on a constant generalised force Q over the step, to first order:
  /// Δq = response.q Q, Δq̇ = response.q_dot Q. For contact.
  struct Response {
    rod::StrainMatrix q, q_dot;
  };
  /// By default that of the implicit Euler rule.
  virtual Response response(const HeldBody& body, const HandleForcing& handle, double h, const StrainState& state);

  /// Saves or restores the history: calls `state(a_, b_, …)` with every member that it keeps from step to step.
  virtual void exchange(math::StateArchive&) {}
  /// Whether restoring a history overwrites all that it keeps, so that one integrator can serve several runs in turn.
  virtual bool restores_all() const { return false; }
};

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
