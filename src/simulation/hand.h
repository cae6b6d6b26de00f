#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "spring_workbench/tools/grasp_selection.h"
#include "spring_workbench/tools/tool.h"
#include "tool_hold.h"
#include "workbench.h"

namespace spring_workbench {

constexpr double same_time = 1e-9;  ///< [s]; stamps nearer to each other are one

/// One stylus: its motion and button, the tool in it, and what that holds.
class Hand {
 public:
  /// Keeps references to scene, settings (changed by calibration) and workbench.
  Hand(const Scene& scene, SimulationSettings& settings, Workbench& workbench, Tool tool);

  /// Forgets samples and buttons, holds nothing. The workbench is reset beside it.
  void reset();

  bool push(const PoseSample& sample) { return track_.push(sample); }
  void push_button(double t, bool pressed) { buttons_.push_back({t, pressed}); }
  const PoseTrack& track() const { return track_; }
  /// Whether a sample says where the hand is at time `now` [s].
  bool known(double now) const { return !track_.empty() && now >= track_.begin() - same_time; }
  /// The time after `now` at which the next piece of the motion begins; infinity where there is none.
  double next_sample(double now);
  /// The time after `now` of the next button edge; infinity where there is none.
  double next_button(double now) const;

  /// The pose at `now`, where it is known.
  void follow(double now);
  void forget_before(double now);

  /// What is the tip in (highlight)?
  void select(double now);
  /// Grasps and releases, as the button's edges up to `now` and `grasp.object` say.
  void apply_buttons(double now);
  bool holds() const { return hold_ != nullptr; }
  void let_go(bool thrown, double now);
  /// What is held, ready to be carried over the next `h` [s]; null where nothing is held, or where it rests and nothing has
  /// to be done.
  SteppedBody* begin_step(double now, double h);
  std::size_t held() const { return held_; }  ///< in the workbench
  /// After it has been carried.
  void end_step(AdvanceReport& report);

  /// Another tool, also while holding: the object goes on from its pose and twist, the new tool's strain is zero.
  void select_tool(Tool tool, double now);

  // Changes of the settings reach what is held. The settings are changed before.
  void change_dofs(ChangeReport& change);
  void change_springs();
  void change_integrator();
  /// Springs and dampers from the held object and its grasp. False when nothing is held on a tool with springs.
  bool calibrate(ChangeReport& change);

  double elastic_energy() const;
  /// The families that ran since the last call of begin_call().
  ForkDofs families_run() const;
  void begin_call() { moved_ = false; }
  ToolState state() const;

 private:
  struct ButtonEvent {
    double t;
    bool pressed;
  };
  void grasp(std::size_t object, const std::optional<RigidTransform>& X_OE, bool follow_hand, double now);
  bool dynamic() const { return hold_ && hold_->coordinates() > 0; }  ///< there is something for an integrator to do
  /// The families that the object can move: of those switched on, the ones in which it has an inertia.
  ForkDofs possible_dofs(std::size_t object, const RigidTransform& X_OE) const;
  /// A hold on the object at its pose, free of strain; `X_OE`: the tip in the object.
  std::unique_ptr<ToolHold> make_hold(std::size_t object, const RigidTransform& X_OE, double length, double now);
  std::unique_ptr<ToolHold> make_fork(std::size_t object, const RigidTransform& X_OE, double length, double now);
  /// How far the tip is in front of the hand, along z [m].
  double reach() const;
  RigidTransform tip_in_object(std::size_t object, double length) const;
  /// Springs and dampers for what is held; the settings tell the stiffness. False where the tool has no springs.
  bool calibrate_hold();

  const Scene& scene_;
  SimulationSettings& settings_;
  Workbench& workbench_;
  Tool tool_;
  PoseTrack track_;
  std::deque<ButtonEvent> buttons_;
  RigidTransform X_WH_;
  double ray_length_;  ///< to what the ray hits [m]
  GraspSelection selection_;
  bool grasped_by_name_ = false;
  std::unique_ptr<ToolHold> hold_;       ///< while something is held
  RigidTransform X_OE_;                  ///< its grasp
  bool moved_ = false;                   ///< what is held, in this call of advance
  double energy_added_before_ = 0.0;
  std::size_t held_ = 0;            ///< in the workbench
};

}  // namespace spring_workbench
