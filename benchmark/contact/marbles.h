#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// Marbles of 10 mm in a held tray, which is tilted by ± 20° for 4 s and then held level for 1 s.
ContactTrial tilted_marbles(int marbles, double duration);
/// Runs 100 and 1,000 marbles; `quick`: 27 for 0.4 s.
void run_marbles(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
