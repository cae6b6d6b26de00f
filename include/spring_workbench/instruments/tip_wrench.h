#pragma once

#include <algorithm>

#include "spring_workbench/motion/external_wrench.h"
#include "spring_workbench/tools/settings.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// Converts the wrench that a machine measured on the held object to virtual units and world axes, at the tip.
inline Wrench measured_at_tip(const motion::ExternalWrench& measured, const tools::ToolState& tool) {
  const bool of_tip = measured.axes == motion::ExternalWrench::Axes::tip;
  const Matrix3d R = tool.force_scale * (of_tip ? Matrix3d(tool.X_WE.linear()) : Matrix3d(Matrix3d::Identity()));
  return {R * measured.wrench.force, R * measured.wrench.moment};
}

/// The wrench at a tool's tip reduced to its limits, world axes.
struct LimitedWrench {
  double share = 1.0;  ///< largest fraction of the moment that is within the limits; 1 if no limit is exceeded
  Wrench W;
};

/// Scales the force down to its limit, and the moment by the same factor and, if needed, further to its own limit.
inline LimitedWrench limited_wrench(const tools::LimitSettings& limit, const tools::ToolState& tool) {
  const auto& [force, moment] = tool.tip_wrench_W;
  const double of_force = std::min(limit.force / force.norm(), 1.0);
  const double of_moment = std::min(limit.moment / moment.norm(), of_force);
  return {of_moment, {of_force * force, of_moment * moment}};
}

}  // namespace spring_workbench::instruments
