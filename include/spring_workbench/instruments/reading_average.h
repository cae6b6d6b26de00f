#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// Averages a tool's weight and torque over the last second in which it carried one thing. The uncertainty is that of
/// the mean of parts of a tenth of a second each, so that what swings faster does not make it seem better known.
class ReadingAverage {
 public:
  /// Adds the tool's readings at time `t` [s], and fills in their averages; until the first part is complete, the
  /// present reading with an unknown uncertainty. A time before the last one, or another object, starts a new average.
  void take(double t, tools::ToolState& tool);

 private:
  struct Part {
    double duration = 0.0, weight = 0.0, torque = 0.0;  ///< [s]; integrals over it
  };
  struct Instant {
    double t, weight, torque;
    std::string carried;
  };
  void take_down(double t, const tools::ToolState& tool);
  tools::Reading average(double Part::*integral, double present) const;

  std::optional<Instant> last_;
  Part present_;
  std::deque<Part> parts_;
};

}  // namespace spring_workbench::instruments
