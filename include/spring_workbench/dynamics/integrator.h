#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/dynamics/settings.h"

namespace spring_workbench::dynamics {

/// Result of one step of an Integrator: an estimate of its local error, that is, its result minus the exact solution.
struct StepEstimate {
  rod::StrainVector q_error;      ///< estimated error of the active coordinates
  double omega_dt = 0.0;          ///< angular frequency of the stiffest mode [rad/s] times the step [s]; 0: not known
  rod::StrainVector q_dot_error;  ///< estimated error of the rates of these coordinates
  bool converged = true;          ///< whether the method solved its equation; if false, the state is discarded
};

/// Estimate of the error of a run (the state minus the exact solution of the equation of motion), with its uncertainty.
/// Bounds derived from it are empirical upper estimates, not rigorous (doc/model.md, "Error bound").
struct RunError {
  /// Symmetric matrix over the active coordinates and their rates.
  using Spread = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * rod::max_strain_coordinates,
                               2 * rod::max_strain_coordinates>;
  StrainState estimate;  ///< estimated error of coordinates and rates
  /// Ellipsoid about the estimate within which the error is expected: e = (strain, rate) of the error minus the
  /// estimate fulfils eᵀ spread⁻¹ e ≤ 1. Positive semi-definite.
  Spread spread;
  double uncertainty = 0.0;  ///< largest deviation of the last step's error from its estimate, an amplitude [m √kg]
};

/// Energy and work over one step of an integrator (see EnergyBalance).
struct StepWork {
  double energy_at_end = 0.0;  ///< energy at the end of the step [J]
  double work = 0.0;           ///< integral of EnergyBalance::power over the step [J]
};

/// Integrates the held body's equation of motion over a step (doc/model.md, "Integrators"). To add a method, override
/// order() and step() and call register_integrator(), as in examples/02_own_integrator. All else is optional. Overloads
/// of HeldBody for math::Pack, which holds several numbers, only make built-in methods fast: a method that calls the
/// overloads for `double` can ignore packs. Results derived from the equations may be kept while HeldBody::version()
/// is unchanged. step() must not allocate memory. Not thread-safe: each held object has its own integrator.
class Integrator {
 public:
  virtual ~Integrator() = default;

  virtual int order() const = 0;  ///< order of accuracy for smooth motions
  /// Optional. Whether the method is stable at any stiffness. Default: false. If it is not and fails to solve a step,
  /// shorter steps are tried if a tolerance is set; otherwise an L-stable fallback takes the step.
  virtual bool stiffly_stable() const { return false; }
  /// How the method changes the energy of a motion without damping; this decides which steps are accepted.
  enum class Energy {
    conserved,       ///< conserved up to an error; a step with too large an error is not accepted
    dissipated,      ///< partly lost, as by implicit methods of low order; a step that gains too much is not accepted
    unbounded,       ///< arbitrary, as by explicit methods; the energy is not checked
    not_applicable,  ///< the method relaxes to a target; its error estimates refer to its own limit for short steps
  };
  /// Optional. The effect of this method. Default: unbounded.
  virtual Energy energy() const { return Energy::unbounded; }
  /// Whether the result converges to the solution of the equation of motion as the steps get shorter.
  bool solves_the_equation_of_motion() const { return energy() != Energy::not_applicable; }

  /// Replaces `state` at time `t` by the state at `t + h` [s], h > 0; `handle` must cover that time. Returns an
  /// estimate of the local error. Set its `converged` to false if the method found no solution.
  virtual StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                            StrainState& state) = 0;

  /// Optional. Replaces `deviation`, a small change of the state `begin` at time `t` [s], by the change that it causes
  /// in the state `end` at `t + h`. For runs with a tolerance. Default: calls step() once more and subtracts.
  virtual void propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                                   const StrainState& begin, const StrainState& end, StrainState& deviation);

  /// Optional. Whether the method overrides propagate_run_error(). Default: false, and with the setting
  /// `error_bound` the method `exponential` runs alongside this one.
  virtual bool tracks_run_error() const { return false; }
  /// Optional. Propagates `error` over the last step and adds the error of that step. It is called after step(), with
  /// the same body, for each accepted step. Default: does nothing.
  virtual void propagate_run_error([[maybe_unused]] const HeldBody& body, [[maybe_unused]] RunError& error) {}
  /// Optional. Work over the last step along the method's own path. Default: none, and the work is computed
  /// on a smooth curve between both ends of the step.
  virtual std::optional<StepWork> work(const HeldBody&) const { return std::nullopt; }

  /// First-order change of the state at the end of a step by a constant generalised force Q over the step.
  struct Response {
    rod::StrainMatrix q;      ///< change of q per unit of Q
    rod::StrainMatrix q_dot;  ///< change of q̇ per unit of Q
  };
  /// Optional. Returns the response of a step of `h` [s] from `state`, for contact. Default: the response of
  /// the implicit Euler rule.
  virtual Response response(const HeldBody& body, const HandleState& handle, double h, const StrainState& state);

  /// Optional. Saves or restores the history. Override it to call `state(a_, b_)` with all members that a later step()
  /// uses; if one is forgotten, replay and restored runs differ silently. Default: there is no history.
  virtual void archive(math::StateArchive&) {}
  /// Optional. Whether archive() restores everything that step() depends on, so that one integrator may be reused for
  /// another simulation by restoring that simulation's history. Default: false.
  virtual bool restores_completely() const { return false; }
};

/// Makes an integrator of this kind, built in or registered, without history.
std::unique_ptr<Integrator> make_integrator(IntegratorKind kind);

/// Internal: swaps two integrators if both are of one class and restores_completely() is true for it.
void swap_alike(std::unique_ptr<Integrator>& a, std::unique_ptr<Integrator>& b);

/// Registers an integrator of your own under `name`. From then on settings files, parameters, services and
/// DynamicsSettings accept it like a built-in one. `make` is called for each object that is grasped, and again when the
/// integrator is changed; the integrators that it makes must share nothing. Register before the first simulation is
/// made, in the same order in every program that restores a state of another. Throws InputError if `name` is empty or
/// taken.
IntegratorKind register_integrator(const std::string& name, std::function<std::unique_ptr<Integrator>()> make);

}  // namespace spring_workbench::dynamics
