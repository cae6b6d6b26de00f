#pragma once

#include <cstdint>
#include <ostream>
#include <string>

#include "spring_workbench/simulation/settings.h"

namespace spring_workbench::benchmark {

struct SoakOptions {
  std::string scene;  ///< URDF of a scene with targets
  simulation::SimulationSettings settings;
  long steps = 10000000;  ///< of the integrator
  unsigned seed = 1;      ///< of the first operator; each assembly has the next one
};

struct SoakResult {
  long steps = 0;
  int assemblies = 0, placed = 0, targets = 0;
  double simulated_time = 0.0;  ///< [s]
  double largest_energy = 0.0;  ///< kinetic energy of the held object and elastic energy of the tool [J]
  double energy_early = 0.0;    ///< the same in the first tenth of the steps [J]
  double drift = 0.0;           ///< farthest that an object at rest has moved in a rest of 10 s [m]
  long refused = 0;             ///< steps that would not have been finite or bounded
  bool finite = true;           ///< everything that came out, always
  double memory_early = 0.0;    ///< resident [bytes]: the most in the first tenth of the steps
  double memory_late = 0.0;     ///< and in the last
  std::uint64_t hash = 0;       ///< of every object's pose and twist at the end of every assembly, to the bit
};

/// One simulation without end: a simulated operator assembles the scene, the hand and all objects then rest for 10 s,
/// and the next operator begins with everything back at its start, until the steps are taken. A line of CSV to `out`
/// each twentieth of them. Throws InputError as load_scene and Simulation do.
SoakResult run_soak(const SoakOptions& options, std::ostream& out);

}  // namespace spring_workbench::benchmark
