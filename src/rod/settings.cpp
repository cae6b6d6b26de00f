#include "spring_workbench/rod/settings.h"

#include <cmath>

namespace spring_workbench::rod {

const std::vector<std::string>& names_of(ShapeKind) {
  static const std::vector<std::string> names = {"constant", "linear", "bushing"};
  return names;
}

const std::vector<std::string>& names_of(DampingLaw) {
  static const std::vector<std::string> names = {"per_dof", "modal", "coefficients"};
  return names;
}

double stretch_damping(const ForkSettings& fork, double mass) {
  if (fork.damping_law == DampingLaw::coefficients) return fork.damping_coefficient.stretch;
  return 2.0 * fork.damping_ratio.stretch * std::sqrt(mass * fork.stiffness.stretch);
}

}  // namespace spring_workbench::rod
