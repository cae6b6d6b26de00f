#pragma once

#include <vector>

#include "spring_workbench/friction/bounce.h"

namespace spring_workbench::friction {

/// Velocities of a body over a step [m/s, rad/s].
struct BodyVelocities {
  Vector6d start = Vector6d::Zero();  ///< after the impacts at the start
  Vector6d end = Vector6d::Zero();
  bool free = false;  ///< neither fixed nor moved by anything but contact and gravity
};

/// Which bodies move over a step of `h` [s] with the mean of the velocities at its start and end, which is exact under
/// constant loads. The others move with the velocity at the end, with which contacts are solved: those with a loaded
/// contact that asks for it, that closes or opens in the step or in which a slip ends, those that would otherwise go
/// deeper into another body, and all free ones that press on them. `resting`: slip that counts as none [m/s].
std::vector<bool> move_with_mean_velocity(const std::vector<BodyVelocities>& bodies,
                                          const std::vector<BouncingContact*>& contacts, double h, double resting);

}  // namespace spring_workbench::friction
