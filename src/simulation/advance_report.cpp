#include <algorithm>

#include "hand.h"

namespace spring_workbench::simulation {
namespace {

std::vector<std::string> names_where(const decltype(AdvanceReport::ran)& set) {
  const char* const names[] = {"stretch", "bend",        "torsion",   "error_bound",
                               "gravity", "free_bodies", "collision", "movable_neighbours"};
  std::vector<std::string> found;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i]) found.emplace_back(names[i]);
  }
  return found;
}

}  // namespace

void add_to(AdvanceReport& report, const stepping::StepEstimates& e) {
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

void AdvanceReport::add(const AdvanceReport& later) {
  steps += later.steps;
  simulated_time += later.simulated_time;
  position_error = std::max(position_error, later.position_error);
  angle_error = std::max(angle_error, later.angle_error);
  local_error_bound = std::max(local_error_bound, later.local_error_bound);
  error_bound = std::max(error_bound, later.error_bound);
  angle_error_bound = std::max(angle_error_bound, later.angle_error_bound);
  steps_unbounded += later.steps_unbounded;
  energy_balance += later.energy_balance;
  stiffest_omega_dt = std::max(stiffest_omega_dt, later.stiffest_omega_dt);
  steps_among_movable += later.steps_among_movable;
  collision_queries += later.collision_queries;
  substeps += later.substeps;
  stops += later.stops;
  steps_fallback += later.steps_fallback;
  energy_error += later.energy_error;
  steps_blocked += later.steps_blocked;
  steps_unsolved += later.steps_unsolved;
  time_lost += later.time_lost;
  steps_rejected += later.steps_rejected;
  wrench_timeouts += later.wrench_timeouts;
  ran |= later.ran;
}

std::vector<std::string> AdvanceReport::active() const { return names_where(ran); }
std::vector<std::string> AdvanceReport::skipped() const { return names_where(~ran); }

}  // namespace spring_workbench::simulation
