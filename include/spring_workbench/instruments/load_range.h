#pragma once

#include <vector>

#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/settings.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// The range of loads in a scene: from none to the weight of its heaviest object. In proportion to the load or, if the
/// weights of the objects span more than a decade, to its logarithm.
class LoadRange {
 public:
  LoadRange(const scene::Scene& scene, const tools::WorldGoal& goal);

  /// Fills in the tool's readings as an instrument, in the scene's units, from its wrench and poses.
  void read(tools::ToolState& tool) const;
  /// The larger of the tip's force and of its moment over the tool's length [N].
  static double load(const tools::ToolState& tool);
  /// Position of a load [N] in the range: 0 … 1.
  double place(double load) const;
  double full() const { return full_; }  ///< [N], > 0
  /// Of the objects, from the heaviest to the lightest [N].
  const std::vector<double>& weights() const { return weights_; }

 private:
  double force_scale_, gravity_;
  double full_;
  double none_ = 0.0;  ///< where a logarithmic range begins [N]; 0: it is linear
  std::vector<double> weights_;
};

/// A tool of `length` [m] that holds nothing, its stylus at `X_WS`.
tools::ToolState unloaded(tools::Tool tool, const rod::ForkSettings& fork, dynamics::IntegratorKind integrator,
                          double length, const RigidTransform& X_WS);

}  // namespace spring_workbench::instruments
