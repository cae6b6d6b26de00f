#pragma once

#include <cstddef>
#include <limits>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::hand_input {

/// One thing that a feed gave to its simulation. The same things in the same order, each once the simulation has gone
/// to the same time, give the same future, bit by bit.
struct Accepted {
  enum class Kind {
    pose,         ///< of the handle at time `t`, as it is followed
    button_down,  ///< the grasp button, at time `t`
    button_up,
    next_tool,  ///< the second button, at time `t`
    lost,       ///< the hand lets go of what it holds, for it was lost until `t`
    rest,       ///< nothing: all hands rested until `t`
  };

  Kind kind = Kind::rest;
  std::size_t hand = 0;
  double t = 0.0;                                               ///< [s]
  RigidTransform X_WH = RigidTransform::Identity();             ///< of a pose
  double committed = -std::numeric_limits<double>::infinity();  ///< simulated time reached before it [s];
                                                                ///< −infinity before the simulation began
};

}  // namespace spring_workbench::hand_input
