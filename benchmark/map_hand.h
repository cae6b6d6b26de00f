#pragma once

#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::benchmark {

/// What the hand does in a cell of the stability map. Each comes to rest at the end.
enum class MapHand {
  lissajous,  ///< 0.15 m at 1 to 1.7 Hz, ± 0.6 rad, for 0.2 s
  jump,       ///< 1 m from one sample to the next
  flip,       ///< half a turn from one sample to the next
  dropout,    ///< no sample for a second, and then 0.3 m and 0.5 rad further on
  noise       ///< 1 mm and 1° at every sample, for 0.2 s
};
std::string name_of(MapHand hand);

/// The samples of a hand, and when it rests for certain: from one end of a step to another.
struct MapHandMotion {
  std::vector<motion::PoseSample> samples;
  std::vector<std::pair<double, double>> rests;  ///< begin, end [s]
};

/// Sampled every `interval` [s], for a simulation in steps of `step` [s].
MapHandMotion map_hand_motion(MapHand hand, double interval, double step);

}  // namespace spring_workbench::benchmark
