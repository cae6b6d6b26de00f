#pragma once

namespace spring_workbench::assembly {

/// How the simulated operator moves. The numbers are those of people reaching for things in the literature, rounded.
struct OperatorSettings {
  unsigned seed = 1;             ///< of everything random
  double rate = 50.0;            ///< samples per second [Hz], 1 … 1000
  double reaction = 0.2;         ///< delay with which the operator perceives the scene [s], 0 … 2
  double position_noise = 1e-4;  ///< of the tracker: standard deviation per axis and sample [m], 0 … 0.1
  double angle_noise = 5e-4;     ///< the same about each axis [rad], 0 … 1
  double aim_scatter = 0.02;     ///< a reach ends off its goal by this part of its length, per axis, 0 … 0.5
};

}  // namespace spring_workbench::assembly
