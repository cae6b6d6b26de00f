#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "spring_workbench/hand_input/feed.h"

namespace spring_workbench::live {

/// The input starts again: all times that follow count from `zero`.
struct NewEpoch {
  std::int64_t zero = 0;  ///< [ns]
};
/// A pose of the handle as it came, in the frame P that is its parent, and when it came.
struct StylusPose {
  hand_input::RawSample sample;
  std::string parent;  ///< P's name
  RigidTransform X_WP = RigidTransform::Identity();
  hand_input::LocalTime arrival;
  double age = 0.0;  ///< when it came, by its stamp [s]
};
/// One that the gate did not let through.
struct RejectedPose {
  hand_input::GateResult result;
  StylusPose pose;
};
/// A button went down or up at time `t` [s].
struct StylusButton {
  double t = 0.0;
  motion::Press press = motion::Press::grasp;
};
/// The buttons are known up to time `t` [s]: a message about them came, whether or not one of them changed.
struct ButtonsKnown {
  double t = 0.0;
  hand_input::LocalTime arrival;
};
using StylusEvent = std::variant<NewEpoch, StylusPose, StylusButton, ButtonsKnown>;

/// What came of each stylus since the last cycle.
using HandEvents = std::array<std::vector<StylusEvent>, simulation::Simulation::most_hands>;

}  // namespace spring_workbench::live
