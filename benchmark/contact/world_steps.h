#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// How far a run of the dynamic world with some step is from the exact or a converged one.
struct WorldStepRow {
  std::string scene;
  std::string against;       ///< "exact" or "converged"
  double step = 0.0;         ///< [s]
  double error = 0.0;        ///< [m], of a body's centre, largest of what is looked at
  double error_share = 0.0;  ///< of how far the body has gone
  double cpu_us_per_simulated_second = 0.0;
};

template <typename Fields>
void each_field(WorldStepRow& r, Fields& fields) {
  fields(r.scene, r.against, r.step, r.error, r.error_share, r.cpu_us_per_simulated_second);
}

/// A box that slides and stops, a sphere that slips and then rolls, and one that bounces, in the world alone and
/// against their exact solutions; a held box that pushes another, through Simulation, against a run with steps of 0.1
/// ms. Empty where there is no Bullet. `quick`: fewer steps.
std::vector<WorldStepRow> measure_world_steps(bool quick);

/// Whether there is contact mode `dynamic` in this build.
bool has_dynamic_contact();

}  // namespace spring_workbench::benchmark
