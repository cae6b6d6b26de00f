#pragma once

#include "options.h"

namespace spring_workbench::assembly_trials {

/// Runs the trials and writes what was asked for. Throws InputError.
void run(const Options& options);

}  // namespace spring_workbench::assembly_trials
