#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "spring_workbench/instruments/material_estimate.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// Averages a tool's weight and torque over the last second in which it carried one thing. The uncertainty is that of
/// the mean of parts of a tenth of a second each, so that what swings faster does not make it seem better known. While
/// the probe touches one thing, it identifies that thing's material.
class ReadingAverage {
 public:
  /// Adds the tool's readings at time `t` [s], and fills in their averages; until the first part is complete, the
  /// present reading with an unknown uncertainty. A time before the last one, or another object, starts a new average.
  /// `X_WT`: of the object that the probe touches, if it is one that can move.
  void take(double t, tools::ToolState& tool, const RigidTransform& X_WT = RigidTransform::Identity());
  /// Fills in the averages of what was taken last, if `tool` carries or touches the same; otherwise its own reading
  /// with an unknown uncertainty.
  void fill_in(tools::ToolState& tool) const;
  /// Returns what the present touch of the probe shows; none without one.
  const std::optional<MaterialReading>& material() const { return material_; }
  std::vector<MaterialEstimate::CurvePoint> force_over_depth() const {
    return touch_ ? touch_->estimate.curve() : std::vector<MaterialEstimate::CurvePoint>();
  }

 private:
  struct Part {
    double duration = 0.0, weight = 0.0, torque = 0.0;  ///< [s]; integrals over it
  };
  struct Instant {
    double t, weight, torque;
    std::string carried;
  };
  struct Touch {
    double t;
    std::string touched;
    double probe_stiffness;
    Vector3d axis_T;  ///< of the probe, as the touch began
    MaterialEstimate estimate;
  };
  void take_down(double t, const tools::ToolState& tool);
  void touch(double t, const tools::ToolState& tool, const RigidTransform& X_WT);
  tools::Reading average(double Part::*integral, double present) const;

  std::optional<Instant> last_;
  Part present_;
  std::deque<Part> parts_;
  std::optional<Touch> touch_;
  std::optional<MaterialReading> material_;
};

}  // namespace spring_workbench::instruments
