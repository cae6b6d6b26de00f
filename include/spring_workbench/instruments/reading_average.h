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
  /// Takes the tool's readings at time `t` [s] down, and fills in their averages: before a part is over what is read
  /// now, without a known uncertainty. An earlier time than before, or another object, starts anew.
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
