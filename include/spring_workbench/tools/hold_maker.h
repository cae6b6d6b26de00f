#pragma once

#include <memory>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/tool.h"
#include "spring_workbench/tools/tool_hold.h"

namespace spring_workbench::tools {

/// Geometry of a tool's hold on an object.
struct Grasp {
  Tool tool = Tool::spring_fork;
  std::size_t object = 0;                            ///< index among the movable objects
  RigidTransform X_WS = RigidTransform::Identity();  ///< pose of the stylus
  RigidTransform X_OE = RigidTransform::Identity();  ///< pose of the tip in the object
  double reach = 0.0;                                ///< distance from the stylus to the tip along z [m]
  double length = 0.0;  ///< length of the spring part of a fork [m]; the rest of the reach is rigid

  void archive(math::StateArchive& state) { state(tool, object, X_WS, X_OE, reach, length); }
};

/// The object to be grasped.
struct GraspedBody {
  std::size_t index = 0;  ///< index in the scene
  const scene::Body& body;
  RigidTransform X_WO;

  bool massless() const { return !(body.mass_properties.mass > 0.0); }
};

/// Makes the holds of tools on objects.
class HoldMaker {
 public:
  /// Keeps references. `gravity` [m/s²] along −z of world.
  HoldMaker(const rod::ForkSettings& fork, const dynamics::DynamicsSettings& dynamics, double gravity)
      : fork_(fork), dynamics_(dynamics), gravity_(gravity) {}

  /// Makes a hold without strain, at time `now` [s], which needs the hand's motion, or a restored state, before it is
  /// used. If it replaces the hold `before`, it takes over that one's integrator.
  std::unique_ptr<ToolHold> make(const Grasp& grasp, const GraspedBody& object, double now,
                                 ToolHold* before = nullptr) const;
  /// Makes the object, at time `now` [s], a body that no tool holds and that tools can push. Its mass must be > 0.
  std::unique_ptr<ToolHold> make_pushable(const GraspedBody& object, const Twist& V_WO_W, double now) const;
  /// Makes the object a free body with this twist, under the constant wrench `load_W` of tools at their limits, at its
  /// centre, world axes.
  std::unique_ptr<bodies::SteppedBody> make_pulled(const Grasp& grasp, const GraspedBody& object, const Twist& V_WO_W,
                                                   const Wrench& load_W) const;
  /// The DOFs in which the object can move: those that are on and in which it has inertia.
  rod::ForkDofs possible_dofs(const Grasp& grasp, const GraspedBody& object) const;

 private:
  std::unique_ptr<ToolHold> make_fork(const Grasp& grasp, const GraspedBody& object, stepping::StepControl control,
                                      double now) const;
  dynamics::BodyInertia inertia(const Grasp& grasp, const GraspedBody& object) const;

  const rod::ForkSettings& fork_;
  const dynamics::DynamicsSettings& dynamics_;
  double gravity_;
};

}  // namespace spring_workbench::tools
