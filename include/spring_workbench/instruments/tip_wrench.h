#pragma once

#include <algorithm>
#include <optional>

#include "spring_workbench/motion/external_wrench.h"
#include "spring_workbench/tools/settings.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// What a machine measures on what the tool holds: at the tip, world axes, in virtual units.
inline Wrench measured_at_tip(const motion::ExternalWrench& measured, const tools::ToolState& tool) {
  const bool of_tip = measured.axes == motion::ExternalWrench::Axes::tip;
  const Matrix3d R = tool.force_scale * (of_tip ? Matrix3d(tool.X_WE.linear()) : Matrix3d(Matrix3d::Identity()));
  return {R * measured.wrench.force, R * measured.wrench.moment};
}

/// What a tool may do at its tip of what it does, world axes, where that is more than its limit: the force cut down to
/// its limit, and the moment in the same proportion and to its own.
inline std::optional<Wrench> cut_down(const tools::LimitSettings& limit, const tools::ToolState& tool) {
  const auto& [force, moment] = tool.tip_wrench_W;
  const double of_force = std::min(limit.force / force.norm(), 1.0);
  const double of_moment = std::min(limit.moment / moment.norm(), of_force);
  if (!(of_moment < 1.0)) return std::nullopt;
  return Wrench{of_force * force, of_moment * moment};
}

}  // namespace spring_workbench::instruments
