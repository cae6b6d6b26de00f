#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// A ring of 576 triangles is held around a movable peg of 4 m, which also carries four loose rings. A fork of 200 …
/// 20,000 N/m moves the ring violently for 0.2 s: at random velocities up to 5 m/s and 50 rad/s, which change after 0.1
/// s.
ContactTrial rings_on_peg(unsigned seed);
/// Runs `count` seeded motions; writes a row for each and a summary.
void run_rings(int count, int first, const TakeRow& take);

/// A chain of ten rings of 576 triangles; the uppermost is held and swung at up to 2 m/s for 2 s, with direction and
/// frequency chosen by the seed.
ContactTrial swung_chain(unsigned seed);
void run_chains(int count, int first, const TakeRow& take);

}  // namespace spring_workbench::benchmark
