#pragma once

#include <optional>
#include <string>

#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// How strongly a hand should feel that what its tool holds strikes something or is jolted: from the impulse of
/// contacts that begin and from the rate at which the force at the tip changes, both in real units. It dies away.
class Vibration {
 public:
  /// Adds the tool at time `t` [s]; `impulse`: of the contacts of what it holds that began since the last call, in
  /// virtual units [N·s]. Returns the intensity, 0 … 1. A time before the last one, or another object, starts again.
  double feel(double t, const tools::ToolState& tool, double impulse);

 private:
  struct Instant {
    double t;
    std::string held;
    Vector3d force;  ///< at the tip, virtual units [N]
  };
  std::optional<Instant> last_;
  double intensity_ = 0.0;
};

}  // namespace spring_workbench::instruments
