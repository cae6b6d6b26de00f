#pragma once

#include <functional>
#include <memory>
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

/// What is known of the error of a run, the state less the exact solution of the equation of motion.
struct RunError {
  using Moments = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * rod::max_strain_coordinates,
                                2 * rod::max_strain_coordinates>;
  StrainState estimate;
  /// The ellipsoid about the estimate that holds it: of (strain, rate) the error e less the estimate has
  /// eᵀ spread⁻¹ e ≤ 1. Positive semi-definite.
  Moments spread;
  double unsure = 0.0;  ///< how much the last step's own error may differ from its estimate, as an amplitude [m √kg]
};

/// One way to carry the held body's state over a step (doc/model.md, "Integrators"). An integrator may keep what it has
/// derived from the equations and the last step; HeldBody::version() tells when that is out of date.
/// No allocation in a step.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Order of accuracy for smooth motions.
  virtual int order() const = 0;
  /// Whether the step is stable at any stiffness.
  virtual bool stiffly_stable() const { return false; }
  /// What the method does to the energy of a motion. It keeps it up to its error; or dissipates some (implicit methods
  /// of low order); or changes it without a bound (explicit ones); or has an energy of its own, because it does not
  /// solve the equation of motion (HeldBody) but relaxes to a target. StepControl bounds the first by its error and the
  /// second by its balance. The estimates of the last are of the distance from the method's own limit.
  enum class Energy { kept, dissipated, unbounded, of_its_own };
  virtual Energy energy() const { return Energy::unbounded; }
  /// Whether short steps lead to the equation of motion.
  bool solves_the_equation_of_motion() const { return energy() != Energy::of_its_own; }

  /// Carries `state` from `t` to `t + h` [s], h > 0; `handle` must cover that time.
  virtual StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                            StrainState& state) = 0;

  /// Carries a small deviation from `begin` over the step from there to `end`: by default the difference of two steps
  /// of the method.
  virtual void carry(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                     const StrainState& begin, const StrainState& end, StrainState& deviation);

  /// Whether the method has an interpolant whose defect it samples, so that it can follow the error of a run.
  virtual bool follows_errors() const { return false; }
  /// Carries what is known of the run's error over the step that was done last, and adds what that one errs by.
  virtual void follow(const HeldBody&, RunError&) {}

  /// How the state at the end of the step depends on a constant generalised force Q over the step, to first order:
  /// Δq = response.q Q, Δq̇ = response.q_dot Q. For contact.
  struct Response {
    rod::StrainMatrix q, q_dot;
  };
  /// By default that of the implicit Euler rule.
  virtual Response response(const HeldBody& body, const HandleForcing& handle, double h, const StrainState& state);

  /// The history: what it keeps of the equations and the last step, to be restored into an integrator of the same name.
  virtual void exchange(math::StateArchive&) {}
};

std::unique_ptr<Integrator> make_integrator(IntegratorKind kind);

/// Registers an integrator of your own under `name`: from then on settings files, parameters, services and
/// DynamicsSettings accept it like a built-in one. `make` is called for each object that is grasped, and again when the
/// integrator is changed; the integrators that it makes share nothing. Call it before the first simulation is made, in
/// the same order in every program that restores a state saved by another one. Throws InputError for a name that is
/// empty or taken.
IntegratorKind register_integrator(const std::string& name, std::function<std::unique_ptr<Integrator>()> make);

}  // namespace spring_workbench::dynamics
