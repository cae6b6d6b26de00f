#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// Fifteen cards of 60 × 90 × 1 mm and 2 g, friction 0.5, in three storeys: three, two and one pairs that lean against
/// each other at 20°, and on each two neighbouring pairs a horizontal card that carries the next pair. The hand keeps
/// it awake at the top, or pulls out a card of the lowest storey sideways.
ContactTrial card_house(bool pulled, double duration);
/// Tests that it stands for 10 s, and that it falls when a card is pulled out.
void run_card_houses(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
