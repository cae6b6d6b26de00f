#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// Repeats a pushed pile of 2×2×2 boxes in contact mode `dynamic`, also with another body 10 m away that rests or
/// falls, and counts the bits of all poses and twists that differ at any sample.
void run_same_bits(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
