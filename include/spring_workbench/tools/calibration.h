#pragma once

#include "spring_workbench/rod/settings.h"

namespace spring_workbench {

/// What the fork does under the object's weight when it is calibrated (paper, sections 3.1 and 4).
struct CalibrationGoal {
  double extension = 0.05;   ///< static extension, hanging, as a fraction of the fork's length
  double deflection = 0.1;   ///< static transverse deflection, held level, as a fraction of the fork's length
  double twist = 0.2;        ///< static twist under the weight at the object's half extent [rad]
};

/// Stiffness of a fork of `length` [m] for an object of `mass` [kg] ≥ 0 and `half_extent` [m] > 0 in a gravity of
/// `gravity` [m/s²]; without gravity as on Earth. A massless object gets the stiffness of one of 1 mg.
PerFamily calibrated_stiffness(double mass, double half_extent, double length, double gravity,
                               const CalibrationGoal& goal = {});

}  // namespace spring_workbench
