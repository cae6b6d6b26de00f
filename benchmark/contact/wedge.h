#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// A wedge with two faces 5° from vertical between two blocks: one of 1 kg that leans on a fixed wall, and one of 1,000
/// kg that slides on the bench. The held wedge moves down at 10 mm/s on a fork of 1e6 N/m and pushes the heavy block
/// away.
ContactTrial driven_wedge(double friction);
/// The wedge of 0.1 kg is loose, and the held block of 1 kg presses it with 100 N against the heavy one.
ContactTrial squeezed_wedge(double friction);
/// Runs both with friction 0.05 and 0.3. The force on the wedge has an exact ratio to that on the block; the loose
/// wedge must stay if and only if the friction is above tan 5°.
void run_wedges(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
