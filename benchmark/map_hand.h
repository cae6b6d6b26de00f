#pragma once

#include <string>
#include <vector>

#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::benchmark {

/// What the hand does first in a cell of the stability map.
enum class MapHand {
  jump,    ///< 1 m from one sample to the next
  flip,    ///< half a turn from one sample to the next
  dropout  ///< no sample for a second, and then 0.3 m and 0.5 rad further on
};
std::string name_of(MapHand hand);

/// And then.
enum class MapTail {
  rest,
  nanometre,              ///< trembles by so much at every sample
  micrometre,             ///< the same
  tenth_of_a_millimetre,  ///< the same
  millimetre,             ///< the same
  lissajous               ///< 0.15 m at 1 to 1.7 Hz, ± 0.6 rad
};
std::string name_of(MapTail tail);

/// From one end of a step to another [s].
struct WatchedTime {
  double begin = 0.0, end = 0.0;
  bool rests = true;  ///< for certain; else the hand trembles, and does not turn for certain
};

/// The samples of a hand, and when it rests or does not turn, in order.
struct MapHandMotion {
  std::vector<motion::PoseSample> samples;
  std::vector<WatchedTime> watched;
};

/// Sampled every `interval` [s], for a simulation in steps of `step` [s]; `seconds` of `tail`.
MapHandMotion map_hand_motion(MapHand hand, MapTail tail, double seconds, double interval, double step);

}  // namespace spring_workbench::benchmark
