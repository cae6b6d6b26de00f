#pragma once

#include <vector>

#include "spring_workbench/Accepted.h"
#include "spring_workbench/Change.h"
#include "spring_workbench/Contacts.h"
#include "spring_workbench/ForkState.h"
#include "spring_workbench/ObjectState.h"
#include "spring_workbench/StepReport.h"
#include "spring_workbench/TaskState.h"
#include "spring_workbench/assembly/task_monitor.h"
#include "spring_workbench/live/journal.h"

namespace spring_workbench::manipulation {

// Conversion of the core's types to messages, in the same frames and units.
ObjectState to_message(const bodies::BodyState& object);
/// `fork_diameter`: diameter of the coil as a fraction of the rest length.
ForkState to_message(const tools::ToolState& tool, double fork_diameter);
TaskState to_message(const std::vector<assembly::Placement>& placements, const assembly::TaskScore& score);
Contacts to_message(const std::vector<contact::ContactState>& contacts);
Accepted to_message(const hand_input::AcceptedInput& accepted);
Change to_message(const live::Change& change);
/// Fills in everything except the cycle's times, `integrator` and `deadline_missed`, which the core does not know.
StepReport to_message(const simulation::AdvanceReport& report);

}  // namespace spring_workbench::manipulation
