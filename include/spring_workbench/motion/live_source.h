#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::motion {

/// One measurement of one station (receiver, S) of a tracking device, in the axes of its transmitter T, as it came.
struct StationSample {
  int station = 1;                   ///< 1, 2, …
  double received = 0.0;             ///< when its last byte came [s], steady clock; later for each of a station
  Vector3d p_TS = Vector3d::Zero();  ///< [m]
  Quaterniond q_TS = Quaterniond::Identity();  ///< finite, its norm near 1; not normalised
  bool button = false;                         ///< the stylus' button is down; false for stations without one
  char warning = ' ';                          ///< the device's own letter for "I doubt this one"; blank: none
  bool next_tool = false;                      ///< the button for the next tool is down
  bool clutch = false;                         ///< the clutch's button is down
};

/// What a live source says about itself.
struct SourceHealth {
  bool streaming = false;  ///< samples are coming
  std::string text;        ///< one line for the user: what it does, or what is wrong and what helps
  std::map<std::string, std::size_t> counters;  ///< by name, since the start; they only grow
};

/// A device that is there now: its samples come when they come. It opens what it needs by itself, and after every
/// failure tries again for as long as it lives; nothing it meets outside ends it. To be used from one thread.
class LiveSource {
 public:
  virtual ~LiveSource() = default;
  /// Waits until there are samples, at most `timeout` [s]; none where none came. In the order in which they came.
  virtual std::vector<StationSample> read(double timeout) = 0;
  virtual SourceHealth health() const = 0;
};

}  // namespace spring_workbench::motion
