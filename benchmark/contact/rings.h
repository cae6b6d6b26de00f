#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// A ring of 576 triangles is held around a movable peg of 4 m, which carries four loose rings, too, and is moved
/// wildly for 0.2 s: at up to 5 m/s and 50 rad/s, drawn anew after 0.1 s, by a fork of 200 … 20,000 N/m.
ContactTrial rings_on_peg(unsigned seed);
/// N seeded motions: a row for each, and one of all.
void run_rings(int count, int first, const TakeRow& take);

/// A chain of ten rings of 576 triangles; the uppermost is held and swung at up to 2 m/s for 2 s, along a direction and
/// at a frequency drawn by the seed.
ContactTrial swung_chain(unsigned seed);
void run_chains(int count, int first, const TakeRow& take);

}  // namespace spring_workbench::benchmark
