#include "spring_workbench/tools/calibration.h"

#include <algorithm>

namespace spring_workbench {

PerFamily calibrated_stiffness(double mass, double half_extent, double length, double gravity,
                               const CalibrationGoal& goal) {
  constexpr double earth = 9.81, least_mass = 1e-6;
  const double weight = std::max(mass, least_mass) * (gravity > 0.0 ? gravity : earth);
  return {weight / (goal.extension * length), weight / (goal.deflection * length), weight * half_extent / goal.twist};
}

}  // namespace spring_workbench
