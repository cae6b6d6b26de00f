#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::stepping {

/// Bounds on the errors at the object's centre of mass (doc/model.md, "Error bound").
struct ErrorBounds {
  std::optional<double> local;     ///< largest bound of a step's local error in position [m]; none if no step has one
  std::optional<double> position;  ///< of the run's error in position, since the run was last exact [m]
  std::optional<double> angle;     ///< of the run's error in orientation, since then [rad]
  int unbounded = 0;               ///< steps without a bound

  void add(const ErrorBounds& next) {
    local = std::max(local, next.local);
    position = std::max(position, next.position);
    angle = std::max(angle, next.angle);
    unbounded += next.unbounded;
  }
  void archive(math::StateArchive& state) { state(local, position, angle, unbounded); }
};

/// Report of StepControl::advance() on one span of time.
struct ControlledStep {
  bool accepted = true;         ///< false: no step was possible from the given state, and none was taken
  int steps = 0;                ///< steps taken
  int substeps = 0;             ///< discarded attempts, each repeated with shorter steps (which count as `steps`)
  int fallback = 0;             ///< steps taken by fallback_step()
  int stops = 0;                ///< steps that met the end of the rod's range, or of the bushing's chart
  double position_error = 0.0;  ///< largest estimate of a step's local error, at the object's centre of mass [m]
  double angle_error = 0.0;     ///< that estimate for the orientation of the object [rad]
  double energy_error = 0.0;    ///< sum of the estimates of the steps' errors in energy [J]
  double energy_added = 0.0;    ///< energy gained beyond the work of hand, gravity, contact and dampers [J]
  double omega_dt = 0.0;        ///< largest ω·dt of the stiffest mode
  ErrorBounds bounds;
};

/// Integrates the held body over a span of time, in one step or in as many as needed.
///
/// A method that is stable at any stiffness takes shorter steps (halves, down to a 64th of the span) if it does not
/// solve its equation or does not conserve energy well enough (Integrator::Energy):
/// - In a minute, its energy errors (its own estimate or the gain seen in the motion, whichever is larger) may reach
///   1 % of the present energy. A method that dissipates energy may gain as much.
/// - The shortest steps may spend 0.1 s of this budget in advance.
/// - A step of a dissipative method is not divided if its 64th parts would gain too much, too, by the method's order.
/// - A step that still fails is taken by an L-stable rule that always has a solution (doc/model.md, "Steps that are not
///   solved"). If the method fails in two neighbouring parts of a span, this rule takes the next, longer part whole.
/// - A strain beyond the rod's range meets a stop. So every span is completed.
///
/// A tolerance bounds the error of the run at any time: the sum of the estimates of all local errors so far, each
/// propagated to the present by the method itself. The size of an error is one length [m], which combines the error in
/// the position of the object's centre of mass with the error in angle times the object's radius of gyration. An error
/// that nothing damps may grow by the tolerance in each `undamped_horizon`. A step shorter than 4 µs, or than two
/// ten-thousandths of the span, is accepted whatever its error.
///
/// With `error_bound`, the error of the run is tracked from the grasp on, and restarted after anything that cannot be
/// tracked (propagate_run_error()). If the method has no interpolant of its own, `exponential` runs alongside it, and
/// the distance between the two is tracked.
class StepControl {
 public:
  /// What is kept from one span to the next. It is part of the state.
  struct Memory {
    double next_h = 0.0;                ///< with a tolerance: the next step to try [s]; 0: unknown
    int level = 0;                      ///< without: the shortest step of the last span was its 2^level-th part
    long version = -1;                  ///< version of the equations to which the other members belong
    double t = 0.0;                     ///< time to which the other members belong [s]
    dynamics::StrainState error;        ///< estimated error of the run
    rod::StrainMatrix swing;            ///< from strain rates to the amplitudes that they cause [s]
    double stiffest_omega = 0.0;        ///< frequency of the stiffest undamped mode [rad/s]
    double energy = 0.0;                ///< energy of body and fork at the end of the last step [J]
    double energy_saved = 0.0;          ///< budget of energy errors left over, as a time [s]; negative: used in advance
    dynamics::StrainState exact;        ///< estimate of the exact state
    dynamics::RunError::Spread spread;  ///< uncertainty of that estimate (RunError)
    dynamics::StrainState end;          ///< state at the end of the last span
    double error_bound = 0.0;           ///< bound on the error in position at the end of the last span [m]
    double angle_bound = 0.0;           ///< bound of its error in orientation [rad]
    bool bounded = false;               ///< whether the two bounds are valid (doc/model.md, "Error bound")

    void archive(math::StateArchive& state) {
      state(next_h, level, version, t, error, swing, stiffest_omega, energy, energy_saved, exact, spread, end,
            error_bound, angle_bound, bounded);
    }
  };

  /// `tolerance` [m], 0 … largest_tolerance; with 0 each span is one step, if possible.
  explicit StepControl(std::unique_ptr<dynamics::Integrator> integrator, double tolerance = 0.0,
                       bool error_bound = false);
  /// Swaps the integrators if they are of the same class, so that what the one of `other` has derived is not lost. Call
  /// before a history is restored.
  void swap_integrator(StepControl& other) { dynamics::swap_alike(integrator_, other.integrator_); }
  dynamics::Integrator& integrator() const { return *integrator_; }
  double tolerance() const { return tolerance_; }  ///< [m]

  /// Carries `state` over the span from `t` to `t + h` [s], h > 0; `handle` must cover that time.
  ControlledStep advance(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                         dynamics::StrainState& state, Memory& memory) const;

  /// Saves or restores the histories of the integrators.
  void archive(math::StateArchive& state);

  static constexpr double undamped_horizon = 1.0;   ///< [s]
  static constexpr double largest_tolerance = 0.1;  ///< [m]

 private:
  struct Span;   ///< the arguments of one call of advance()
  struct Tried;  ///< a trial step with its error estimates

  Tried try_step(const Span& span, double t, double h, const dynamics::StrainState& state) const;
  /// Computes the energy balance of a trial step that may be accepted.
  void weigh(const Span& span, double t, double h, const dynamics::StrainState& state, Tried& tried) const;
  void take(Span& span, double t, double h, const Tried& tried, dynamics::StrainState& state) const;
  void fall_back(Span& span, double t, double h, dynamics::StrainState& state) const;
  /// Takes a 2^level-th part of the span. `failed`: the method failed in the previous part, of the same length, so this
  /// part is not divided. Returns whether the method took any step.
  bool step_in_halves(Span& span, double t, double h, int level, bool failed, dynamics::StrainState& state) const;
  void steps_to_tolerance(Span& span, double t, double h, dynamics::StrainState& state) const;
  void follow_error(Span& span, double t, double h, const Tried& tried, const dynamics::StrainState& begin) const;
  void end_bound(Span& span, double t, const dynamics::StrainState& state) const;

  std::unique_ptr<dynamics::Integrator> integrator_;
  double tolerance_;
  bool error_bound_;
  std::unique_ptr<dynamics::Integrator> companion_;  ///< tracks the error if the integrator cannot
};

/// Makes a StepControl with integrator, tolerance and error bound of the settings.
inline StepControl make_step_control(const dynamics::DynamicsSettings& s) {
  return StepControl(dynamics::make_integrator(s.integrator), s.tolerance, s.error_bound);
}

}  // namespace spring_workbench::stepping
