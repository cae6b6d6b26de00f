#pragma once

#include <string>

namespace spring_workbench {

struct DynamicsSettings {
  std::string integrator = "exponential";  ///< key `integrator`: closed_form, semi_implicit_euler, rk4, exponential
  double step = 0.02;                      ///< key `step` [s], 1e-6 … 1: the largest step; a step also ends at every sample
  std::string inertia = "exact";           ///< key `inertia`: exact, or point_mass (the paper's I = r² m, section 3.1)
};

}  // namespace spring_workbench
