#pragma once

#include <algorithm>
#include <memory>

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::stepping {

/// Bounds of errors at the object's centre of mass (doc/model.md, "Error bound").
struct ErrorBounds {
  double local = 0.0;     ///< of a step's local error in position, the largest [m]; infinite: none
  double position = 0.0;  ///< of the run's error since it was exact, the largest [m]
  double angle = 0.0;     ///< of its error in attitude [rad]
  int unbounded = 0;      ///< steps for which there are none

  void add(const ErrorBounds& next) {
    local = std::max(local, next.local);
    position = std::max(position, next.position);
    angle = std::max(angle, next.angle);
    unbounded += next.unbounded;
  }
  void exchange(math::StateArchive& state) { state(local, position, angle, unbounded); }
};

/// Report of a StepControl on a span of time.
struct ControlledStep {
  bool accepted = true;         ///< false: no step was possible from the given state, and none was taken
  int steps = 0;                ///< steps taken
  int substeps = 0;             ///< discarded attempts, each repeated with shorter steps (not the steps taken instead)
  int fallback = 0;             ///< steps taken by fallback_step()
  int stops = 0;                ///< steps that met the end of the rod's range, or of the bushing's chart
  double position_error = 0.0;  ///< largest estimate of a step's local error, at the object's centre of mass [m]
  double angle_error = 0.0;     ///< the same of its attitude [rad]
  double energy_error = 0.0;    ///< sum of the estimates of the steps' errors in energy [J]
  double energy_added = 0.0;    ///< beyond what hand, gravity, contact and dampers account for [J]
  double omega_dt = 0.0;        ///< largest ω·dt of the stiffest mode
  ErrorBounds bounds;
};

/// Integrates the held body over a span of time, in one step or in as many as needed.
///
/// A method that is stable at any stiffness takes shorter steps (halves, down to a 64th of the span) if it does not
/// solve its equation or conserve energy well enough (Integrator::Energy). Its energy error (its own estimate or the
/// gain seen in the motion, whichever is larger) may add up, in a minute, to a hundredth of the energy there is; a
/// method that dissipates energy may gain as much. The shortest steps may use the budget of a tenth of a second in
/// advance. A step that still fails is taken by an L-stable rule that always has a solution (fallback_step.h); where
/// the method takes none of two neighbouring parts of a span, that rule takes the next, longer part as a whole. A
/// strain beyond the rod's range meets a stop (range_stop.h). So every span is completed.
///
/// A tolerance bounds the error of the run at any time: the estimates of all local errors so far, each propagated to
/// the present by the method itself. Its size is the distance of the object's centre of mass from where it should be
/// [m] and the angle times the object's radius of gyration, as one length. Where nothing damps an error away, it may
/// grow by the tolerance in each `undamped_horizon`. A step of less than 4 µs, or two ten-thousandths of the span, is
/// taken whatever its error.
///
/// With `error_bound`, the error of the run is followed from the grasp on, and restarted after anything that cannot be
/// followed (Integrator::follow). For a method without an interpolant of its own, `exponential` is carried along, and
/// what is followed is the distance between the two.
class StepControl {
 public:
  /// What goes on from one span to the next; belongs to the state.
  struct Memory {
    double next_h = 0.0;          ///< with a tolerance: the next step to try [s]; 0: not known
    int level = 0;                ///< without: the last span's shortest step was its 2^level-th part
    long version = -1;            ///< of the equations that the rest is about
    double t = 0.0;               ///< time that the rest is of [s]
    dynamics::StrainState error;  ///< of the run
    rod::StrainMatrix swing;      ///< from rates to the strains that they swing to [s]
    double stiffest_omega = 0.0;  ///< of the undamped modes [rad/s]
    double energy = 0.0;          ///< of body and fork at the end of the last step [J]
    double energy_saved = 0.0;    ///< of the error in energy that steps may have: left over, or owed, as a time [s]
    dynamics::StrainState exact;  ///< where the run should be, as far as known
    dynamics::RunError::Moments spread;  ///< how far that may be off (RunError)
    dynamics::StrainState end;           ///< of the last span
    double error_bound = 0.0;            ///< of the object's position at the end of the last span [m]
    double angle_bound = 0.0;            ///< of its attitude [rad]
    bool bounded = false;                ///< whether these are bounds (doc/model.md, "Error bound")

    void exchange(math::StateArchive& state) {
      state(next_h, level, version, t, error, swing, stiffest_omega, energy, energy_saved, exact, spread, end,
            error_bound, angle_bound, bounded);
    }
  };

  /// `tolerance` [m]: 0 takes spans as they come; up to largest_tolerance.
  explicit StepControl(std::unique_ptr<dynamics::Integrator> integrator, double tolerance = 0.0,
                       bool error_bound = false);
  /// Before a history is restored: swaps the integrators if they are alike, so that what `other` has derived is kept.
  void swap_integrator(StepControl& other) { dynamics::swap_alike(integrator_, other.integrator_); }
  dynamics::Integrator& integrator() const { return *integrator_; }
  double tolerance() const { return tolerance_; }  ///< [m]

  /// From `t` to `t + h` [s], h > 0; `handle` must cover that time.
  ControlledStep advance(const dynamics::HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                         dynamics::StrainState& state, Memory& memory) const;

  /// The integrators' histories.
  void exchange(math::StateArchive& state);

  static constexpr double undamped_horizon = 1.0;   ///< [s]
  static constexpr double largest_tolerance = 0.1;  ///< [m]

 private:
  struct Span;   ///< one call's arguments
  struct Tried;  ///< a step and what it says of itself

  Tried try_step(const Span& span, double t, double h, const dynamics::StrainState& state) const;
  /// Takes the energy balance of a step that may be taken.
  static void weigh(const Span& span, double t, double h, const dynamics::StrainState& state, Tried& tried);
  void take(Span& span, double t, double h, const Tried& tried, dynamics::StrainState& state) const;
  void fall_back(Span& span, double t, double h, dynamics::StrainState& state) const;
  /// Takes a 2^level-th part of the span. `failed`: the method took no step of the part before it, of the same length,
  /// so this part is not divided. Returns whether it took any.
  bool step_in_halves(Span& span, double t, double h, int level, bool failed, dynamics::StrainState& state) const;
  void steps_to_tolerance(Span& span, double t, double h, dynamics::StrainState& state) const;
  void follow_error(Span& span, double t, double h, const Tried& tried, const dynamics::StrainState& begin) const;
  void end_bound(Span& span, double t, const dynamics::StrainState& state) const;

  std::unique_ptr<dynamics::Integrator> integrator_;
  double tolerance_;
  bool error_bound_;
  std::unique_ptr<dynamics::Integrator> companion_;  ///< follows the error where the integrator does not
};

/// Of the integrator and the tolerance of the settings.
inline StepControl make_step_control(const dynamics::DynamicsSettings& s) {
  return StepControl(dynamics::make_integrator(s.integrator), s.tolerance, s.error_bound);
}

}  // namespace spring_workbench::stepping
