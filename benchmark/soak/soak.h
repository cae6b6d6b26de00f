#pragma once

#include <cstdint>
#include <ostream>
#include <string>

#include "spring_workbench/simulation/settings.h"

namespace spring_workbench::benchmark {

struct SoakOptions {
  std::string scene;  ///< URDF of a scene with targets
  simulation::SimulationSettings settings;
  long steps = 10000000;  ///< number of integrator steps
  unsigned seed = 1;      ///< seed of the first operator, incremented for each assembly
};

struct SoakResult {
  long steps = 0;
  int assemblies = 0, placed = 0, targets = 0;
  double simulated_time = 0.0;  ///< [s]
  double largest_energy = 0.0;  ///< kinetic energy of the held object and elastic energy of the tool [J]
  double energy_early = 0.0;    ///< the same in the first tenth of the steps [J]
  double drift = 0.0;           ///< largest displacement of a resting object during a rest of 10 s [m]
  long rejected = 0;            ///< steps rejected as not finite or not bounded
  bool finite = true;           ///< whether all results were finite
  double memory_early = 0.0;    ///< resident memory [bytes]: maximum in the first tenth of the steps
  double memory_late = 0.0;     ///< and in the last
  std::uint64_t hash = 0;       ///< hash of all bits of every object's pose and twist at the end of each assembly
};

/// Runs one long simulation: a simulated operator assembles the scene, the hand and all objects rest for 10 s, and the
/// next operator starts again from the initial state, until all steps are taken. Writes a CSV row to `out` for every 5
/// %. Throws InputError as load_scene and Simulation do.
SoakResult run_soak(const SoakOptions& options, std::ostream& out);

}  // namespace spring_workbench::benchmark
