#pragma once

#include <memory>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/tools/tool.h"
#include "tool_hold.h"
#include "workbench.h"

namespace spring_workbench {

/// How a tool is about to hold an object.
struct Grasp {
  Tool tool;
  std::size_t object;   ///< in the workbench
  RigidTransform X_WS;  ///< the stylus
  RigidTransform X_OE;  ///< the tip in the object
  double reach;         ///< from the stylus to the tip, along z [m]
  double length;        ///< of the spring part of a fork [m]; the rest of the reach is rigid
};

/// Makes a tool's hold on an object.
class HoldMaker {
 public:
  /// Keeps references.
  HoldMaker(const Scene& scene, const SimulationSettings& settings, const Workbench& workbench)
      : scene_(scene), settings_(settings), workbench_(workbench) {}

  /// A hold free of strain, at time `now` [s]. It has to be told the hand's motion before it can be used.
  std::unique_ptr<ToolHold> make(const Grasp& grasp, double now) const;
  /// The families that the object can move: of those switched on, the ones in which it has an inertia.
  ForkDofs possible_dofs(const Grasp& grasp) const;

 private:
  std::unique_ptr<ToolHold> make_fork(const Grasp& grasp, double now) const;
  BodyInertia inertia(const Grasp& grasp) const;

  const Scene& scene_;
  const SimulationSettings& settings_;
  const Workbench& workbench_;
};

}  // namespace spring_workbench
