#pragma once

#include <memory>

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::dynamics {

/// What a StepControl did over a span of time.
struct ControlledStep {
  bool accepted = true;         ///< false: no state to go on from was found, and none was taken
  int steps = 0;                ///< steps taken
  int rejected = 0;             ///< steps tried and taken again shorter
  int energy_held = 0;          ///< steps whose gain of energy was taken away (see StepControl)
  double position_error = 0.0;  ///< largest estimate of a step's local error, at the object's centre of mass [m]
  double angle_error = 0.0;     ///< the same of its attitude [rad]
  double omega_dt = 0.0;        ///< largest ω·dt of the stiffest mode
};

/// Carries the held body over a span of time with an integrator: in one step, or, with a tolerance, in as many as it
/// takes.
///
/// With a tolerance, what is held to it is the error that the run has at any time: the estimates of all local errors so
/// far, each carried on by the linearised equations to the present. Its size is the distance of the object's centre of
/// mass from where it should be [m] and the angle times the object's radius of gyration, as one length. Where nothing
/// damps an error away, it may grow by the tolerance in each `undamped_horizon`. A step of less than 4 µs, or two
/// ten-thousandths of the span, is taken whatever its error: a span ends, in up to 10,000 steps, where none keeps the
/// tolerance.
///
/// An integrator that no stiffness limits is guarded besides. A step with a large local error is taken again in halves;
/// a fork at the end of its way stops there. While the handle rests and no contact pushes, energy may not grow: what a
/// step gains is taken from its speed, or else its way is cut short. The guard costs one more evaluation of the energy
/// a step while the handle rests, nothing while it moves. Explicit methods are left as they are.
class StepControl {
 public:
  /// What goes on from one span to the next; belongs to the state.
  struct Memory {
    double next_h = 0.0;          ///< the next step to try [s]; 0: not known
    long version = -1;            ///< of the equations that the rest is about
    double t = 0.0;               ///< time that the rest is of [s]
    StrainState error;            ///< of the run
    long omega_version = -1;      ///< of the equations that the next is of
    double stiffest_omega = 0.0;  ///< of the undamped modes, where the integrator does not know its own [rad/s]
    bool rests = false;           ///< the handle, since:
    RigidTransform X_WH = RigidTransform::Identity();
    double lowest_energy = 0.0;  ///< of the body and the fork [J]
    double energy_scale = 0.0;   ///< what rounding is measured by [J]

    void exchange(math::StateArchive& state) {
      state(next_h, version, t, error, omega_version, stiffest_omega, rests, X_WH, lowest_energy, energy_scale);
    }
  };

  /// `tolerance` [m]: 0 takes spans as they come; up to largest_tolerance.
  explicit StepControl(std::unique_ptr<Integrator> integrator, double tolerance = 0.0);

  Integrator& integrator() const { return *integrator_; }
  double tolerance() const { return tolerance_; }  ///< [m]

  /// From `t` to `t + h` [s], h > 0; `handle` must cover that time.
  ControlledStep advance(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                         StrainState& state, Memory& memory) const;

  static constexpr double undamped_horizon = 1.0;   ///< [s]
  static constexpr double largest_tolerance = 0.1;  ///< [m]

 private:
  struct Span;  ///< one call's arguments

  /// One step, or with a tolerance, where the integrator's own estimate would not do, the same in two halves.
  StepEstimate step_with_estimate(const Span& span, double t, double h, StrainState& state) const;
  bool try_step(Span& span, double t, double h, StrainState& state, StepEstimate& estimate) const;
  bool step_in_halves(Span& span, double t, double h, int level, StrainState& state) const;
  bool steps_to_tolerance(Span& span, double t, double h, StrainState& state) const;

  std::unique_ptr<Integrator> integrator_;
  double tolerance_;
};

}  // namespace spring_workbench::dynamics
