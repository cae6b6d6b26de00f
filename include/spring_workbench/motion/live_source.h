#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::motion {

/// One unfiltered measurement of one station (receiver S) of a tracking device, in the frame of its transmitter T.
struct StationSample {
  int station = 1;                   ///< 1, 2, …
  double received = 0.0;             ///< arrival of its last byte [s], steady clock; strictly increasing per station
  Vector3d p_TS = Vector3d::Zero();  ///< [m]
  Quaterniond q_TS = Quaterniond::Identity();  ///< finite, norm near 1, not normalised
  bool button = false;                         ///< whether the stylus' button is down; false for stations without one
  char warning = ' ';                          ///< the device's warning code for this sample; blank: none
  bool next_tool = false;                      ///< whether the button for the next tool is down
  bool clutch = false;                         ///< whether the clutch button is down
};

/// Health of a live source, as reported to the user.
struct SourceHealth {
  bool streaming = false;                       ///< whether samples arrive
  std::string text;                             ///< one line: its state, or what is wrong and how to fix it
  std::map<std::string, std::size_t> counters;  ///< by name, since the start; never decreasing
};

/// A device whose samples arrive in real time. It opens its port by itself and tries again after every failure, so no
/// external failure is fatal. Not thread-safe.
class LiveSource {
 public:
  virtual ~LiveSource() = default;
  /// Waits for samples, at most `timeout` [s]. Returns them in the order of arrival; empty if none arrived.
  virtual std::vector<StationSample> read(double timeout) = 0;
  virtual SourceHealth health() const = 0;
};

}  // namespace spring_workbench::motion
