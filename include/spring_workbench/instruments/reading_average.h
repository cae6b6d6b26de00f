#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "spring_workbench/instruments/material_estimate.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// Averages a tool's weight and torque over the last second, as long as it carries the same object. The uncertainty is
/// the standard error over intervals of a tenth of a second, so faster oscillations do not make it too small. While the
/// probe touches one body, it also identifies that body's material.
class ReadingAverage {
 public:
  /// Adds the tool's readings at time `t` [s] and fills in their averages; until the first interval is complete, these
  /// are the current readings with unknown uncertainty. A time before the last one, or another object, starts a new
  /// average. `X_WT`: pose of the touched object, if it is movable.
  void add(double t, tools::ToolState& tool, const RigidTransform& X_WT = RigidTransform::Identity());
  /// Fills in the latest averages if `tool` carries or touches the same object; otherwise its own readings with unknown
  /// uncertainty.
  void fill_in(tools::ToolState& tool) const;
  /// Returns the material estimate of the current touch of the probe; none if it touches nothing.
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
    double probe_stiffness, probe_damping;
    Vector3d axis_T;  ///< axis of the probe at the start of the touch
    MaterialEstimate estimate;
  };
  void record_instant(double t, const tools::ToolState& tool);
  void touch(double t, const tools::ToolState& tool, const RigidTransform& X_WT);
  tools::Reading average(double Part::*integral, double present) const;

  std::optional<Instant> last_;
  Part present_;
  std::deque<Part> parts_;
  std::optional<Touch> touch_;
  std::optional<MaterialReading> material_;
};

}  // namespace spring_workbench::instruments
