#include "spring_workbench/rod/settings.h"

#include <cmath>
#include <sstream>

#include "spring_workbench/validation/names.h"

namespace spring_workbench::rod {

const std::vector<std::string>& names_of(ShapeKind) {
  static const std::vector<std::string> names = {"constant", "linear", "bushing"};
  return names;
}

const std::vector<std::string>& names_of(DampingLaw) {
  static const std::vector<std::string> names = {"per_dof", "modal", "coefficients"};
  return names;
}

std::string in_words(const ForkSettings& fork) {
  const auto all = [](const PerDof& v, const std::string& force, const std::string& moment) {
    std::ostringstream text;
    text << v.stretch << force << ", " << v.bend << force << ", " << v.torsion << moment;
    return text.str();
  };
  const bool ratios = fork.damping_law != DampingLaw::coefficients;
  std::vector<std::string> on;
  if (fork.dofs.stretch) on.push_back("stretch");
  if (fork.dofs.bend) on.push_back("bend");
  if (fork.dofs.torsion) on.push_back("torsion");
  return "stiffness " + all(fork.stiffness, " N/m", " N m/rad") + "; damping " +
         all(fork.damping(), ratios ? "" : " N s/m", ratios ? "" : " N m s/rad") + " (" +
         validation::name_of(fork.damping_law) + "); DOFs on: " + (on.empty() ? "none" : validation::join(on));
}

double stretch_damping(const ForkSettings& fork, double mass) {
  if (fork.damping_law == DampingLaw::coefficients) return fork.damping_coefficient.stretch;
  return 2.0 * fork.damping_ratio.stretch * std::sqrt(mass * fork.stiffness.stretch);
}

bool ForkChange::changes_springs() const {
  return !stiffness.empty() || !damping_ratio.empty() || !damping_coefficient.empty() || damping_law ||
         !damping.empty();
}

ForkSettings ForkChange::applied_to(ForkSettings fork) const {
  fork.dofs = dofs.applied_to(fork.dofs);
  fork.stiffness = stiffness.applied_to(fork.stiffness);
  fork.damping_ratio = damping_ratio.applied_to(fork.damping_ratio);
  fork.damping_coefficient = damping_coefficient.applied_to(fork.damping_coefficient);
  fork.damping_law = damping_law.value_or(fork.damping_law);
  fork.damping() = damping.applied_to(fork.damping());
  const bool one_per_dof = !damping.empty() && !damping_law && !fork.damping_ratio.uniform();
  if (one_per_dof && fork.damping_law == DampingLaw::modal) fork.damping_law = DampingLaw::per_dof;
  return fork;
}

ForkChange change_to(const ForkSettings& fork) {
  const auto all = [](const PerDof& v) { return PerDofChange<double>{v.stretch, v.bend, v.torsion}; };
  return {{fork.dofs.stretch, fork.dofs.bend, fork.dofs.torsion},
          all(fork.stiffness),
          all(fork.damping_ratio),
          all(fork.damping_coefficient),
          fork.damping_law,
          {}};
}

}  // namespace spring_workbench::rod
