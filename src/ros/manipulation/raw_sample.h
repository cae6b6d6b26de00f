#pragma once

#include <geometry_msgs/Transform.h>

#include "spring_workbench/live/stylus_events.h"

namespace spring_workbench::manipulation {

/// A transform as it came, as the gate takes it; `t` [s].
inline hand_input::RawSample raw_sample(const geometry_msgs::Transform& T, double t) {
  return {t, Vector3d(T.translation.x, T.translation.y, T.translation.z),
          Quaterniond(T.rotation.w, T.rotation.x, T.rotation.y, T.rotation.z)};
}

}  // namespace spring_workbench::manipulation
