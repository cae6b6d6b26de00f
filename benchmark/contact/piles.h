#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// A pile of `across` × `across` × `high` boxes of 4 cm and 0.1 kg, whose lowest layer a held bar pushes 50 mm in 1 s.
ContactTrial pushed_pile(int across, int high, double step);
/// Piles of 2×2×2, 3×3×3 and 5×5×4 boxes at 20 ms, each against a run with a tenth of its step; quick: the first.
void run_piles(bool quick, const TakeRow& take);

/// Ten boxes on one another, the top `ratio` times as heavy as the others (1 kg), kept awake.
ContactTrial standing_stack(double ratio, double duration);
/// Nine such boxes, pressed down 10 mm by a tenth on a fork.
ContactTrial pressed_stack(double stiffness, double step);
/// Ratios of 1, 1e3, 1e6 for 60 s; forks of 1 … 1e9 N/m, every decade, at steps of 1, 5, 20 and 50 ms; quick: few.
void run_stacks(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
