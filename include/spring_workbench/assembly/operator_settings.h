#pragma once

namespace spring_workbench::assembly {

/// How the simulated operator moves. The defaults are rounded values for human reaching from the literature.
struct OperatorSettings {
  unsigned seed = 1;             ///< seed of all random numbers
  double rate = 50.0;            ///< samples per second [Hz], 1 … 1000
  double reaction = 0.2;         ///< delay with which the operator perceives the scene [s], 0 … 2
  double position_noise = 1e-4;  ///< tracker noise: standard deviation per axis and sample [m], 0 … 0.1
  double angle_noise = 5e-4;     ///< the same about each axis [rad], 0 … 1
  double aim_scatter = 0.02;     ///< end-point error of a reach per axis, as a fraction of its length, 0 … 0.5
};

}  // namespace spring_workbench::assembly
