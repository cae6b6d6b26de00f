#pragma once

#include "spring_workbench/bodies/coupled_tool.h"
#include "spring_workbench/rod/settings.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::tools {

/// What is in front of a hand along its z axis.
struct InFront {
  double distance = 0.0;              ///< [m]
  const scene::Body* body = nullptr;  ///< null: the bench plane
  const scene::Material* material = nullptr;
};

/// The tool `spring_probe` where it touches something (doc/model.md, "The probe"): a spring along the probe's axis in
/// series with the material's, which it reads out. It can only push, without friction at its tip.
class Probe final : public bodies::CoupledTool {
 public:
  /// Touches what is `touched.distance` in front of the hand, nearer than the probe's `length` [m]. Keeps no reference.
  Probe(double length, const rod::ForkSettings& fork, const InFront& touched);

  /// The same touch at a new moment.
  void touch(const InFront& touched) { state_.depth = length_ - touched.distance; }
  void set_springs(const rod::ForkSettings& fork);
  /// The present time [s] and the hand's motion from it on.
  void set_hand(const motion::MotionSegment& hand, double t);

  bodies::Coupling coupling(double h, const RigidTransform& X_WO, const Matrix6d& mobility) const override;
  void follow(double h, const motion::MotionState& object, const Wrench& pull_W) override;
  void save(bodies::TrialStart& start) const override { start.keep(state_); }
  void restore(const bodies::TrialStart& start) override { state_ = start.kept<State>(); }

  /// On a body that does not move: the force is that of the springs at rest.
  void press();

  double elastic_energy() const;
  const scene::Body* body() const { return body_; }
  /// All that changes while it touches the same body.
  void exchange(math::StateArchive& state) {
    state(k_, c_, hand_, state_.t, state_.depth, state_.indent, state_.force);
  }
  /// Fills in what the probe knows; `X_WH`: the hand.
  void describe(const RigidTransform& X_WH, ToolState& state) const;

 private:
  struct State {
    double t = 0.0;
    double depth = 0.0;   ///< how far the tip would be inside, if nothing gave way [m]
    double indent = 0.0;  ///< of the material [m]
    double force = 0.0;   ///< [N]
  };
  /// Where the probe ends, its tip where it touches.
  RigidTransform tip(const RigidTransform& X_WH) const;

  double length_;
  const scene::Body* body_;
  scene::Material material_;
  double k_ = 0.0, c_ = 0.0;  ///< of the probe
  motion::MotionSegment hand_;
  State state_;
};

}  // namespace spring_workbench::tools
