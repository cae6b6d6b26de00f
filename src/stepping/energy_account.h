#pragma once

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::stepping {

/// Difference between two states at the same time.
struct Difference {
  double position = 0.0, angle = 0.0;  ///< of the object [m], [rad]
  double energy = 0.0;                 ///< of body, fork and couplings, less the work of a constant contact load [J]
  double present = 0.0;                ///< energy of the first state, at least its weight over the fork's length [J]
};
Difference difference(const dynamics::HeldBody& body, const dynamics::HandleState& handle,
                      const dynamics::StrainState& state, const dynamics::StrainState& other);

/// Energy of body and fork after a step of `h` to `t + h` [s] beyond what hand, gravity, contact and dampers account
/// for [J]: their work along the path of the integrator's last step, which was this one, where it has one.
double energy_added(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    const dynamics::StrainState& begin, const dynamics::StrainState& end,
                    const dynamics::Integrator& integrator);
/// The same with their work by Lobatto's rule of four points on the cubics through both ends.
double energy_added(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    const dynamics::StrainState& begin, const dynamics::StrainState& end);

/// The motion of the handle over a step of `h` from `t` [s] in a balance that ends with it: its pose and velocity at
/// the end, its accelerations and angular velocity in the middle, the mean of those that change evenly.
dynamics::HandleState over_step(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h);

/// Energy that a step from `begin` to the moment of `handle` gains: of springs and motion in the frame of the handle,
/// and of couplings with frames at rest in it, less the energy before and the work of weight, handle's acceleration and
/// contact as `handle` has them. With those at the end, not above 0 for implicit Euler on a fork that is linear.
class EnergyGain {
 public:
  EnergyGain(const dynamics::HeldBody& body, const dynamics::HandleState& handle, const dynamics::StrainState& begin);
  /// [J] of the step to this state.
  double operator()(const dynamics::StrainState& end) const;

 private:
  double energy(const dynamics::StrainState& state) const;  ///< with that in the constant force [J]

  const dynamics::HeldBody& body_;
  dynamics::HandleState still_;  ///< that of the handle, with the frames of the couplings at rest
  rod::StrainVector q_;          ///< at the begin
  Vector3d force_;               ///< on the object, constant on the way, in the axes of the handle [N]
  rod::StrainVector loads_;      ///< the other forces at the begin, per strain
  double energy_ = 0.0;          ///< at the begin [J]
};

}  // namespace spring_workbench::stepping
