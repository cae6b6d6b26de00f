#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// Error of a run of the dynamic world at some step against the exact solution or a converged run.
struct WorldStepRow {
  std::string scene;
  std::string against;       ///< "exact" or "converged"
  double step = 0.0;         ///< [s]
  double error = 0.0;        ///< largest error of a body's centre at the evaluated times [m]
  double error_share = 0.0;  ///< relative to the displacement of the body
  double cpu_us_per_simulated_second = 0.0;
};

template <typename Fields>
void each_field(WorldStepRow& r, Fields& fields) {
  fields(r.scene, r.against, r.step, r.error, r.error_share, r.cpu_us_per_simulated_second);
}

/// A box that slides and stops, a sphere that slips and then rolls, and one that bounces, in the world alone, compared
/// with their exact solutions; a held box that pushes another, through Simulation, compared with a run with steps of
/// 0.1 ms. Empty if Bullet is missing. `quick`: fewer steps.
std::vector<WorldStepRow> measure_world_steps(bool quick);

/// Whether this build has contact mode `dynamic`.
bool has_dynamic_contact();

}  // namespace spring_workbench::benchmark
