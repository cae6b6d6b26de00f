#pragma once

#include <algorithm>
#include <optional>

#include "spring_workbench/motion/external_wrench.h"
#include "spring_workbench/tools/settings.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// Converts the wrench that a machine measured on the held object: at the tip, world axes, in virtual units.
inline Wrench measured_at_tip(const motion::ExternalWrench& measured, const tools::ToolState& tool) {
  const bool of_tip = measured.axes == motion::ExternalWrench::Axes::tip;
  const Matrix3d R = tool.force_scale * (of_tip ? Matrix3d(tool.X_WE.linear()) : Matrix3d(Matrix3d::Identity()));
  return {R * measured.wrench.force, R * measured.wrench.moment};
}

/// The wrench at a tool's tip reduced to its limits, world axes, if it exceeds them: the force is scaled to its limit,
/// and the moment by the same factor and further to its own limit. None if the wrench is within the limits.
inline std::optional<Wrench> limited_wrench(const tools::LimitSettings& limit, const tools::ToolState& tool) {
  const auto& [force, moment] = tool.tip_wrench_W;
  const double of_force = std::min(limit.force / force.norm(), 1.0);
  const double of_moment = std::min(limit.moment / moment.norm(), of_force);
  if (!(of_moment < 1.0)) return std::nullopt;
  return Wrench{of_force * force, of_moment * moment};
}

}  // namespace spring_workbench::instruments
