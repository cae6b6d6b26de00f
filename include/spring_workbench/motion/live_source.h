#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::motion {

/// One measurement of one station (receiver, S) of a tracking device, in the axes of its transmitter T, unfiltered.
struct StationSample {
  int station = 1;                   ///< 1, 2, …
  double received = 0.0;             ///< when its last byte arrived [s], steady clock; increases for each station
  Vector3d p_TS = Vector3d::Zero();  ///< [m]
  Quaterniond q_TS = Quaterniond::Identity();  ///< finite, its norm near 1; not normalised
  bool button = false;                         ///< the stylus' button is down; false for stations without one
  char warning = ' ';                          ///< the device's own warning about this sample; blank: none
  bool next_tool = false;                      ///< the button for the next tool is down
  bool clutch = false;                         ///< the clutch's button is down
};

/// Health of a live source, as reported to the user.
struct SourceHealth {
  bool streaming = false;                       ///< samples are coming
  std::string text;                             ///< one line: what it does, or what is wrong and how to mend it
  std::map<std::string, std::size_t> counters;  ///< by name, since the start; they only grow
};

/// A device whose samples arrive in real time. It opens what it needs by itself and tries again after every failure; no
/// failure outside the program ends it. Not thread-safe.
class LiveSource {
 public:
  virtual ~LiveSource() = default;
  /// Waits for samples, at most `timeout` [s]. Returns them in the order of arrival; empty if none arrived.
  virtual std::vector<StationSample> read(double timeout) = 0;
  virtual SourceHealth health() const = 0;
};

}  // namespace spring_workbench::motion
