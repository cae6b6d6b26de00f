#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "spring_workbench/hand_input/input_filter.h"

namespace spring_workbench::live {

/// Restart of the input: all following times count from `zero`.
struct NewEpoch {
  std::int64_t zero = 0;  ///< [ns]
};
/// Pose of the handle as received, in its parent frame P, with its arrival.
struct StylusPose {
  hand_input::RawSample sample;
  std::string parent;  ///< name of P
  RigidTransform X_WP = RigidTransform::Identity();
  hand_input::LocalTime arrival;
  double age = 0.0;  ///< age on arrival by its stamp [s]
};
/// Pose that the gate rejected.
struct RejectedPose {
  hand_input::GateResult result = hand_input::GateResult::accepted;
  StylusPose pose;
};
/// Edge of a button at time `t` [s].
struct StylusButton {
  double t = 0.0;
  motion::ButtonEdge edge = motion::ButtonEdge::grasp;
};
/// A button message with stamp `t` [s] has arrived: the buttons are known up to this time, whether or not one changed.
struct ButtonsKnown {
  double t = 0.0;
  hand_input::LocalTime arrival;
};
/// Measurement of a machine's force sensor on the object that the stylus holds.
struct StylusWrench {
  std::int64_t stamp = 0;         ///< time of the measurement, in local time [ns]
  motion::ExternalWrench sample;  ///< without its time
};
using StylusEvent = std::variant<NewEpoch, StylusPose, StylusButton, ButtonsKnown, StylusWrench>;

/// Events since the last cycle, by stylus.
using HandEvents = std::map<std::size_t, std::vector<StylusEvent>>;

}  // namespace spring_workbench::live
