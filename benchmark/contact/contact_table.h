#pragma once

#include <string>
#include <vector>

#include "benchmark/contact/contact_costs.h"
#include "benchmark/contact/drag.h"
#include "benchmark/contact/impact_search.h"
#include "benchmark/contact/motion_steps.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {

/// Error against run time of contact.
struct ContactTable {
  std::vector<DragRow> drags;
  std::vector<ImpactRow> impacts;
  std::vector<MotionStepRow> motion_steps;
  std::vector<ContactCost> costs;
};

/// `baselines`: drag scenes of the engines. Each run is made in a child process, so the caller must have no other
/// threads.
ContactTable measure_contact(const std::vector<DragMethod>& baselines, bool quick, Units& units);
/// Number of units of work.
std::size_t contact_unit_count(const std::vector<DragMethod>& baselines, bool quick);

std::string drags_csv(const std::vector<DragRow>& rows);
std::string impacts_csv(const std::vector<ImpactRow>& rows);
std::string motion_steps_csv(const std::vector<MotionStepRow>& rows);
std::string contact_costs_csv(const std::vector<ContactCost>& costs);

}  // namespace spring_workbench::benchmark
