#pragma once

#include <string>
#include <vector>

namespace spring_workbench::benchmark {

/// Error of a motion in contact at some step against the exact solution or a converged run.
struct MotionStepRow {
  std::string scene;         ///< the motion and the contact mode
  std::string against;       ///< "exact" or "converged"
  double step = 0.0;         ///< the setting [s]
  double error = 0.0;        ///< largest error of a body's centre at the evaluated times [m]
  double error_share = 0.0;  ///< relative to the displacement of the body
  double cpu_us_per_simulated_second = 0.0;
};

template <typename Fields>
void each_field(MotionStepRow& r, Fields& fields) {
  fields(r.scene, r.against, r.step, r.error, r.error_share, r.cpu_us_per_simulated_second);
}

/// The motions in contact of exact_motions.h in both contact modes, compared with their exact solutions; and a held box
/// that pushes another, compared with a run with steps of 0.1 ms. All through Simulation. Empty if Bullet is missing.
/// `quick`: fewer steps.
std::vector<MotionStepRow> measure_motion_steps(bool quick);

/// Whether this build has contact mode `dynamic`.
bool has_dynamic_contact();

}  // namespace spring_workbench::benchmark
