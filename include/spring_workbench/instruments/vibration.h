#pragma once

#include <optional>
#include <string>

#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// Intensity of the vibration that signals impacts and jolts of the held object to the hand: computed from the impulse
/// of new contacts and from the rate of change of the force at the tip, both in real units. It decays over time.
class Vibration {
 public:
  /// Adds the state of the tool at time `t` [s]. `impulse`: total impulse of the held object's contacts that began
  /// since the last call, in virtual units [N·s]. Returns the intensity, 0 … 1. A time before the last one, or another
  /// object, restarts it.
  double update_intensity(double t, const tools::ToolState& tool, double impulse);

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
