#pragma once

#include <memory>
#include <optional>

#include "spring_workbench/instruments/load_range.h"
#include "spring_workbench/motion/slip.h"
#include "spring_workbench/motion/stylus.h"
#include "spring_workbench/objects/objects.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/tools/axis_hit.h"
#include "spring_workbench/tools/hold_maker.h"
#include "spring_workbench/tools/sharing.h"

namespace spring_workbench::simulation {

/// Adds the error estimates of a hold's steps to the report of an advance.
void add_to(AdvanceReport& report, const stepping::StepEstimates& e);

/// One hand: a stylus, the tool in it, and the object that the tool holds.
class Hand {
 public:
  /// Keeps references to scene, settings and objects.
  Hand(const scene::Scene& scene, const SimulationSettings& settings, objects::Objects& objects, tools::Tool tool);

  /// Forgets all samples and holds nothing. The caller resets the objects.
  void reset();

  /// Takes over the state of `before`, a hand in another scene whose objects must all be in this one, too; its probe
  /// must touch nothing. If it holds the object `new_mass`, whose mass has changed, the springs keep their force.
  void continue_from(Hand& before, const std::string& new_mass, double now);

  motion::Stylus& stylus() { return stylus_; }
  const motion::Stylus& stylus() const { return stylus_; }

  /// Finds the object that the tip is in, and highlights it, or the body that the probe touches.
  void select(double now);
  /// Grasps, releases and changes the tool, according to the button edges up to `now` and to `grasp.object`.
  void apply_buttons(double now);
  bool holds() const { return hold_ != nullptr; }
  void let_go(bool thrown, double now);
  /// Ends the touch of the probe; the touched object keeps its motion, and is touched again if it is still in reach.
  void end_touch(double now);
  /// Keeps the tool in place while the hand moves alone (`on`), or lets it follow again. A held object keeps its twist.
  void set_clutch(bool on, double now);
  /// Returns the object that the tool holds or the probe pushes.
  std::optional<std::size_t> carried() const {
    return hold_ || pushes_ ? std::optional<std::size_t>(grasp_.object) : std::nullopt;
  }
  /// Returns the object that this tool alone holds, ready for a step of `h` [s] under a load; null if it is at rest.
  bodies::SteppedBody* begin_step(double now, double h, const Wrench& load_W);
  /// Prepares a step of `h` [s] of a tool that shares its object with other tools or pushes it.
  tools::ToolOnObject begin_shared_step(double now, double h);
  /// Returns the object that the tool pushes, as a body that no tool holds.
  std::unique_ptr<tools::ToolHold> make_pushable(double now) const {
    return maker().make_pushable(grasped_body(), object().V_WO_W, now);
  }
  /// Ends a step, after the object has been stepped.
  void end_step(AdvanceReport& report);

  /// Changes the tool. A held object continues from its pose and twist; the new tool starts without strain.
  void select_tool(tools::Tool tool, double now);
  /// Returns the wrench of the springs on the held object, at its centre, world axes.
  Wrench spring_pull() const { return hold_->spring_pull(); }
  /// Makes this tool exert `pull_W` on the object from now on, without moving the object.
  void take_over(const Wrench& pull_W, double now);

  const rod::ForkSettings& fork() const { return fork_; }  ///< with all changes and calibrations since the start
  /// Changes the fork, even while it holds an object. The change must be valid.
  void change_fork(const ForkChange& change, std::string& message);
  /// Adopts the changed integrator, step and tolerance of the settings.
  void change_integrator() {
    if (hold_) hold_->step_control() = stepping::make_step_control(settings_.dynamics);
  }
  /// Sets length, springs and dampers to fit the held object, if a tool with springs holds one, and says so.
  void calibrate(std::string& message, double now);

  double elastic_energy() const { return probe_ ? probe_->elastic_energy() : hold_ ? hold_->elastic_energy() : 0.0; }
  /// Returns the DOFs that moved since the last call of begin_call().
  rod::ForkDofs dofs_run() const {
    return hold_ && moved_ ? maker().possible_dofs(grasp_, grasped_body()) : rod::ForkDofs{false, false, false};
  }
  /// Returns whether the hand holds an object with mass on springs.
  bool springs() const { return dynamic() && !objects_.massless(grasp_.object); }
  /// Prepares a step in which the tool slips. Returns the object as an unheld one, under `load_W` at its centre, world.
  bodies::SteppedBody* begin_slip(const Wrench& load_W);
  /// Ends a step of `h` [s] in which the tool slipped, with the stylus at its current pose.
  void end_slip(const Wrench& at_tip_W, double h) {
    slip_.begin(stylus_.X_WS(), hold_->slip(h, {object().X_WO, object().V_WO_W, {}}, at_tip_W));
  }
  void begin_call() { moved_ = false; }
  tools::ToolState state(double now) const;

  /// Saves or restores the state between two calls of `advance`; settings and objects have to be exchanged first.
  void archive(math::StateArchive& state, double now);

 private:
  /// Grasping as in the paper, section 5: insert the fork, adjust it, press and hold, release. A press outside any
  /// object grasps nothing, even if the tip enters an object with the button still down.
  void apply_grasp_button(bool pressed, double now);
  void select_pierced();
  void touch_with_probe(double now);
  void grasp(std::size_t object, const std::optional<RigidTransform>& X_OE, bool follow_hand, double now);
  bool dynamic() const { return hold_ && hold_->coordinates() > 0; }  ///< whether there are coordinates to integrate
  const bodies::BodyState& object() const { return objects_.states()[grasp_.object]; }  ///< the held or pushed object
  double reach() const;  ///< distance of the tip from the hand, along z [m]
  tools::GraspedBody grasped_body() const {
    return {objects_.scene_index(grasp_.object), objects_.body(grasp_.object), object().X_WO};
  }
  /// Returns the grasp of the object at its current pose, for a tool of default size.
  tools::Grasp grasp_of(std::size_t object) const;
  /// Fits the length of the fork's spring part to the size of an object that has mass.
  void fit_size(tools::Grasp& grasp) const;
  tools::HoldMaker maker() const { return {fork_, settings_.dynamics, scene_.gravity}; }
  void make_hold(double now);
  bool to_world() const { return settings_.grasp.calibrate == tools::Calibration::world; }
  /// Sets springs and dampers for the held object or the whole scene, by the settings. Returns false without springs.
  bool calibrate_hold();
  /// Gives the held object this twist, whichever DOFs are off.
  void keep_twist(const Twist& V_WO_W);

  const scene::Scene& scene_;
  const SimulationSettings& settings_;
  const instruments::LoadRange loads_;
  const bodies::Surroundings around_;
  rod::ForkSettings fork_;
  objects::Objects& objects_;
  tools::Tool tool_;
  motion::Stylus stylus_;
  double ray_length_;                    ///< length of the ray up to what it hits [m]
  std::optional<std::size_t> inserted_;  ///< the object that the tip is in, or that the ray hits, while nothing is held
  bool pressed_ = false;                 ///< whether the grasp button is down
  bool grasped_by_name_ = false;
  std::unique_ptr<tools::ToolHold> hold_;  ///< while something is held
  std::unique_ptr<tools::Probe> probe_;    ///< while the probe touches something
  bool pushes_ = false;                    ///< whether the touched body is movable; it is then the grasp's object
  tools::Grasp grasp_;                     ///< of the held object
  bool moved_ = false;                     ///< whether the held object has moved in this call of advance
  double energy_added_before_ = 0.0;
  motion::Slip slip_;
  std::unique_ptr<bodies::SteppedBody> pulled_;  ///< the held object, in a step in which the tool slips
};

}  // namespace spring_workbench::simulation
