#pragma once

#include <algorithm>

#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/stepping/step_estimates.h"

namespace spring_workbench::simulation {

/// Adds what a hold's steps estimate of their errors to the report of an advance.
inline void add_to(AdvanceReport& report, const stepping::StepEstimates& e) {
  report.position_error = std::max(report.position_error, e.position);
  report.angle_error = std::max(report.angle_error, e.angle);
  report.stiffest_omega_dt = std::max(report.stiffest_omega_dt, e.omega_dt);
  report.steps += e.extra_steps;
  report.substeps += e.substeps;
  report.stops += e.stops;
  report.steps_fallback += e.fallback;
  report.energy_error += e.energy;
  report.local_error_bound = std::max(report.local_error_bound, e.bounds.local);
  report.error_bound = std::max(report.error_bound, e.bounds.position);
  report.angle_error_bound = std::max(report.angle_error_bound, e.bounds.angle);
  report.steps_unbounded += e.bounds.unbounded;
}

}  // namespace spring_workbench::simulation
