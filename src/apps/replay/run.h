#pragma once

#include "motion.h"
#include "options.h"
#include "summary.h"

namespace spring_workbench::replay {

/// Loads the scene, moves the hand through it, writes both files. Throws InputError; then no file is left.
Summary run(const Options& options);

}  // namespace spring_workbench::replay
