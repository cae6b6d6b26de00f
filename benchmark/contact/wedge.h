#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// A wedge whose two faces are 5° from upright, between blocks of 1 kg, which leans on a fixed wall, and 1,000 kg,
/// which slides on the bench. Driven: the held wedge goes down at 10 mm/s on a fork of 1e6 N/m and drives the heavy
/// block away.
ContactTrial driven_wedge(double friction);
/// The wedge, 0.1 kg, is loose, and the held block of 1 kg presses it with 100 N against the heavy one.
ContactTrial squeezed_wedge(double friction);
/// Friction 0.05 and 0.3 in both: the force on the wedge is the exact multiple of that on the block; it stays exactly
/// if the friction is above tan 5°.
void run_wedges(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
