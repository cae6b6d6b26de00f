#pragma once

#include <string>

namespace spring_workbench::dynamics {

struct DynamicsSettings {
  std::string integrator = "exponential";  ///< key `integrator`: one of integrator_names()
  double step = 0.02;             ///< key `step` [s], 1e-6 … 1: the largest step; a step also ends at every sample
  double tolerance = 0.0;         ///< key `tolerance` [m], 0 … 0.1: of the run's error; 0: fixed steps (StepControl)
  std::string inertia = "exact";  ///< key `inertia`: exact, or point_mass (the paper's I = r² m, section 3.1)
};

}  // namespace spring_workbench::dynamics
