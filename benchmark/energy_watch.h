#pragma once

#include <limits>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::benchmark {

/// State of a held body and its fork at one moment, as needed by EnergyWatch.
struct EnergyLook {
  double t = 0.0;                          ///< [s]
  double moving = 0.0;                     ///< elastic and kinetic energy [J]
  Vector3d p_WO = Vector3d::Zero();        ///< centre of mass [m]
  Vector3d v_WO_W = Vector3d::Zero();      ///< [m/s]
  Vector3d from_rigid = Vector3d::Zero();  ///< displacement of the centre of mass from its position on a rigid fork [m]
  double estimated = 0.0;                  ///< sum of the steps' estimated errors in energy since the last call [J]
};

/// Monitors the energy of a body on a fork whose handle does not turn: elastic, kinetic and potential energy minus the
/// work of the handle. Dissipation is not included, so growth smaller than it is not detected.
///
/// Between two calls the handle moves along a cubic, v(t) = u0 + u1 t + u2 t². Since the fork has no mass, the force of
/// the handle is m (p̈ + g ẑ), whatever the fork does. Its work, the integral of force times v, therefore follows from
/// position and velocity of the body at both calls, however fast it oscillates in between, except for the term 2 m u2
/// ∫p dt, for which the path in between must be estimated. The error of this estimate is accumulated as uncertainty.
class EnergyWatch {
 public:
  /// `mass` [kg]; `length` of the fork [m]: the weight of the body times this length is the smallest significant
  /// energy.
  EnergyWatch(double mass, double length);

  /// Adds a state; the handle has moved along `handle` since the last one.
  void look(const EnergyLook& now, const motion::MotionSegment& handle);

  /// Largest growth of energy minus work over an earlier value, beyond the steps' own error estimates since then (at
  /// most a hundredth of the largest energy) and the uncertainty; relative to the largest energy.
  double growth() const;
  /// The same without allowing for the steps' estimates.
  double whole_growth() const;
  /// The same beyond twice all of these estimates, which are off by some percent if a step is longer than a period, and
  /// beyond all that the work may be off by however the body oscillates between the calls; relative to the largest
  /// energy.
  double excess() const;
  /// Sum of all estimates, relative to the largest energy.
  double estimates() const { return all_estimated_ / largest_; }
  /// Whether the work is known to a hundredth of the largest energy.
  bool is_certain() const { return uncertainty() <= max_share * largest_; }

  static constexpr double max_share =
      0.01;  ///< fraction of the largest energy; larger error estimates of the steps do not count

 private:
  double uncertainty()
      const;  ///< uncertainty of the work [J]: three times the root of the sum of squares, since tremor is random

  double mass_, largest_;
  EnergyLook last_;
  bool any_ = false;
  double work_ = 0.0, work_squares_ = 0.0, deflection_ = 0.0;
  double lowest_ = std::numeric_limits<double>::infinity();
  double estimated_ = 0.0, all_estimated_ = 0.0;  ///< sums of estimates since the minimum and since the first call [J]
  double growth_ = 0.0, whole_growth_ = 0.0, growth_beyond_all_ = 0.0;
  double work_per_deflection_ = 0.0;  ///< error of the work, relative to the largest deflection [N]
  double work_per_passage_ = 0.0;     ///< error of the work by what the handle moves between the calls [J]
};

}  // namespace spring_workbench::benchmark
