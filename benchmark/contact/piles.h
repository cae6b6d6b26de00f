#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// A pile of `across` × `across` × `high` boxes of 4 cm and 0.1 kg, whose lowest layer a held bar pushes 50 mm in 1 s.
ContactTrial pushed_pile(int across, int high, double step);
/// Runs piles of 2×2×2, 3×3×3 and 5×5×4 boxes at 20 ms, each compared with a run at a tenth of the step; `quick`: the
/// first.
void run_piles(bool quick, const TakeRow& take);

/// A stack of ten boxes, the top one `ratio` times as heavy as the others (1 kg); kept awake.
ContactTrial standing_stack(double ratio, double duration);
/// A stack of nine such boxes that a tenth one on a fork presses down by 10 mm.
ContactTrial pressed_stack(double stiffness, double step);
/// Runs ratios of 1, 1e3, 1e6 for 60 s, and forks of 1 … 1e9 N/m by decades at steps of 1, 5, 20 and 50 ms; `quick`: a
/// few of these.
void run_stacks(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
