#pragma once

#include <string>
#include <vector>

#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::benchmark {

/// Initial event of the hand in a cell of the stability map.
enum class MapHand {
  jump,    ///< 1 m from one sample to the next
  flip,    ///< half a turn from one sample to the next
  dropout  ///< no sample for a second, then a displacement of 0.3 m and 0.5 rad
};
std::string name_of(MapHand hand);

/// Motion of the hand after the initial event.
enum class MapTail {
  rest,
  nanometre,              ///< trembles by this amount at every sample
  micrometre,             ///< the same
  tenth_of_a_millimetre,  ///< the same
  millimetre,             ///< the same
  lissajous               ///< 0.15 m at 1 to 1.7 Hz, ± 0.6 rad
};
std::string name_of(MapTail tail);

/// A time interval between ends of steps [s].
struct WatchedTime {
  double begin = 0.0, end = 0.0;
  bool rests = true;  ///< true: the hand rests; false: it trembles but does not turn
};

/// The samples of a hand and, in order, the intervals in which it rests or does not turn.
struct MapHandMotion {
  std::vector<motion::PoseSample> samples;
  std::vector<WatchedTime> watched;
};

/// Makes a motion sampled every `interval` [s], for a simulation with steps of `step` [s]; `seconds`: duration of
/// `tail`.
MapHandMotion map_hand_motion(MapHand hand, MapTail tail, double seconds, double interval, double step);

}  // namespace spring_workbench::benchmark
