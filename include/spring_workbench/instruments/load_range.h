#pragma once

#include <vector>

#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/settings.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::instruments {

/// The range of loads in a scene, from no load to the weight of its heaviest object. It is linear in the load or, if
/// the weights of the objects span more than a decade, logarithmic.
class LoadRange {
 public:
  LoadRange(const scene::Scene& scene, const tools::WorldGoal& goal);

  /// Fills in the tool's readings (weight, torque, force components, load), in the scene's units, from its wrench and
  /// poses.
  void read(tools::ToolState& tool) const;
  /// Load of a tool [N]: the larger of the force at the tip and the moment at the tip divided by the tool's length.
  static double load(const tools::ToolState& tool);
  /// Position of a load [N] in the range, 0 … 1.
  double place(double load) const;
  double full() const { return full_; }  ///< upper end of the range [N], > 0
  /// Weights of the objects, from the heaviest to the lightest [N].
  const std::vector<double>& weights() const { return weights_; }

 private:
  double force_scale_, gravity_;
  double full_;
  double none_ = 0.0;  ///< lower end of a logarithmic range [N]; 0: the range is linear
  std::vector<double> weights_;
};

/// State of a tool of `length` [m] that holds nothing, with its stylus at `X_WS`.
tools::ToolState unloaded(tools::Tool tool, const rod::ForkSettings& fork, dynamics::IntegratorKind integrator,
                          double length, const RigidTransform& X_WS);

}  // namespace spring_workbench::instruments
