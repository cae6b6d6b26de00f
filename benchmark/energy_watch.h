#pragma once

#include <limits>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::benchmark {

/// What a watch sees of a held body and its fork at one moment.
struct EnergyLook {
  double t = 0.0;                          ///< [s]
  double moving = 0.0;                     ///< elastic and kinetic energy [J]
  Vector3d p_WO = Vector3d::Zero();        ///< centre of mass [m]
  Vector3d v_WO_W = Vector3d::Zero();      ///< [m/s]
  Vector3d from_rigid = Vector3d::Zero();  ///< of the centre of mass from where a rigid fork would hold it [m]
  double estimated = 0.0;  ///< sum of the errors in energy that the steps since the last look say they have [J]
};

/// Watches the energy of a body on a fork whose handle does not turn: elastic, kinetic and potential energy less the
/// handle's work. What dampers take is not counted, so that growth of less than that is not seen.
///
/// The handle moves along a cubic between two looks, v(t) = u0 + u1 t + u2 t². Its force is m (p̈ + g ẑ) whatever the
/// fork does, since the fork has no mass. So its work, the integral of force times v, is known from position and
/// velocity of the body at both looks, however fast it swings between them, but for the term 2 m u2 ∫p dt, for which
/// the way between them must be guessed. How far wrong that may be is summed up as the looks' uncertainty.
class EnergyWatch {
 public:
  /// `mass` [kg]; `length` of the fork [m]: the body's weight times it is the least energy that still means something.
  EnergyWatch(double mass, double length);

  /// The first one, or one more; the handle has moved along `handle` since the last one.
  void look(const EnergyLook& now, const motion::MotionSegment& handle);

  /// The most that energy less work has grown over a value that it had before, beyond the steps' own estimates since
  /// then (a hundredth of the largest energy at most) and the uncertainty. Relative to the largest energy.
  double growth() const;
  /// The sum of all estimates, relative to the largest energy.
  double estimates() const { return all_estimated_ / largest_; }
  /// Whether the work is known to a hundredth of the largest energy.
  bool is_certain() const { return uncertainty() <= most_share * largest_; }

  static constexpr double most_share =
      0.01;  ///< of the largest energy: steps that say they err by more do not excuse it

 private:
  double uncertainty() const;  ///< of the work [J]: three times the root of the looks' squares, since tremor is random

  double mass_, largest_;
  EnergyLook last_;
  bool any_ = false;
  double work_ = 0.0, work_squares_ = 0.0, deflection_ = 0.0;
  double lowest_ = std::numeric_limits<double>::infinity();
  double estimated_ = 0.0, all_estimated_ = 0.0;  ///< since the lowest; since the first look [J]
  double growth_ = 0.0;
};

}  // namespace spring_workbench::benchmark
