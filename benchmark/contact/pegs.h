#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// A held peg, 10 mm deep in a hole that is 0.1 mm wider, is pushed down by 35 mm by a hand that ends 3 mm off the axis
/// and turned by 2°. The peg is a box of 20 mm among four walls, or a cylinder in one concave mesh; the hole is fixed,
/// or, with contact mode `dynamic`, in a movable block of 5 kg.
ContactTrial peg_in_hole(bool round, scene::ContactMode contact);
void run_pegs(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
