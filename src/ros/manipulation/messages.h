#pragma once

#include <vector>

#include "spring_workbench/Contacts.h"
#include "spring_workbench/ForkState.h"
#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/StepReport.h"
#include "spring_workbench/TaskState.h"
#include "spring_workbench/assembly/task_monitor.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::manipulation {

// What the core says as messages: same frames, same units.
ObjectStates to_message(const std::vector<bodies::BodyState>& objects);
ForkState to_message(const tools::ToolState& tool);
TaskState to_message(const std::vector<assembly::Placement>& placements, const assembly::TaskScore& score);
Contacts to_message(const std::vector<contact::ContactState>& contacts);
/// Everything but `wall_time`, `integrator` and `deadline_missed`, which the core does not know.
StepReport to_message(const simulation::AdvanceReport& report);

}  // namespace spring_workbench::manipulation
