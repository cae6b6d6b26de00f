#pragma once

#include "spring_workbench/live/simulation_runner.h"

namespace spring_workbench {

/// Wants a snapshot of every moment.
inline bool always(const live::Moment&) { return true; }

}  // namespace spring_workbench
