#pragma once

#include "benchmark/contact/trial_run.h"

namespace spring_workbench::benchmark {

/// Fifteen cards of 60 × 90 × 1 mm and 2 g, friction 0.5, in three storeys: three, two and one pairs that lean against
/// each other by 20°, and on each two pairs side by side a lying one, which the next pair stands on. Kept awake by the
/// hand at the top, or the hand draws a card of the lowest storey out sideways.
ContactTrial card_house(bool pulled, double duration);
/// It stands for 10 s; it falls when a card is drawn.
void run_card_houses(bool quick, const TakeRow& take);

}  // namespace spring_workbench::benchmark
