#pragma once

#include <string>
#include <vector>

#include "spring_workbench/bodies/stepped_body.h"
#include "spring_workbench/dynamics/coupling.h"
#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/motion/proxy.h"
#include "spring_workbench/stepping/step_control.h"
#include "spring_workbench/stepping/step_estimates.h"
#include "spring_workbench/tools/settings.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::tools {

/// A tool's hold on an object: a body that is moved by the hand through the tool.
class ToolHold : public bodies::SteppedBody {
 public:
  // If several tools hold an object, one leads: it carries the object, and the others pull on it as couplings in its
  // equation of motion. They then follow to the object's new pose (doc/model.md, "Several tools on one object").
  virtual double since() const = 0;  ///< time of the grasp [s]
  /// Returns this tool as the coupling of a follower, for the steps from the current state on.
  virtual const dynamics::Coupling& coupling() = 0;
  /// Makes this tool the leader, with `others` as followers; if there are none, it holds the object alone. Call before
  /// each step.
  virtual void lead(const std::vector<dynamics::Attached>& others) = 0;
  /// Ends the step with the followers, which are no longer used.
  virtual void stop_leading() = 0;
  /// Follows the leader to time `t` [s]; `object`: motion of the object at that time.
  virtual void follow(double t, const ToolHold& leader, const motion::MotionState& object) = 0;
  /// Returns the motion of the hand to which the springs are attached.
  virtual const motion::MotionSegment& hand() const = 0;
  /// Returns the proxy handle, on which the springs act, relative to the handle in the hand.
  virtual const motion::Proxy& proxy() const = 0;

  /// Sets a constant wrench on the object at its centre, world axes, in addition to contact. Call before each step.
  virtual void set_load(const Wrench& load_W) = 0;
  /// Sets the current time [s] and the motion of the hand, which must cover the following steps.
  virtual void set_hand(const motion::MotionSegment& hand, double t) = 0;
  /// Whether nothing moves for the next `h` [s], so that advance_at_rest() is enough: the hand is at rest, and the
  /// object has come to rest on the tool. `may_fall_asleep`: whether nothing else may move it; false wakes it.
  virtual bool sleeps(double h, bool may_fall_asleep) = 0;
  /// Lets `h` [s] pass at rest.
  virtual void advance_at_rest(double h) = 0;
  /// Returns the wrench that the springs, without the dampers, exert on the object at its centre, world axes.
  virtual Wrench spring_pull() const = 0;
  /// Regrasps with the object at `X_WO`: replaces the strain such that the springs exert `pull_W` on the object at its
  /// centre, as far as the tool has springs for it (doc/model.md, "Regrasping").
  virtual void regrasp(const RigidTransform& X_WO, const Wrench& pull_W) = 0;
  /// Ends a step of `h` [s] in which the tool slipped and exerted `at_tip_W` on the object at the tip; `object`: motion
  /// of the object now. Returns the pose of the stylus that matches the tool's strain (doc/model.md, "At the limit").
  virtual RigidTransform slip(double h, const motion::MotionState& object, const Wrench& at_tip_W) = 0;
  /// Brings the object's twist as close to this one as possible.
  virtual void take_twist(const Twist& V_WO_W) = 0;
  /// Sets stiffness and damping ratios; the strain is not changed.
  virtual void set_springs(const rod::ForkSettings& fork) = 0;
  /// Returns the stiffness calibrated to the object as it is held (doc/model.md, "Calibration"). Its mass must be > 0.
  virtual rod::PerDof fitting_stiffness(const rod::ForkSettings& fork, double gravity,
                                        const ObjectGoal& goal) const = 0;
  /// Switches DOFs on and off (fork only). Returns whether one of them is returning to zero strain.
  virtual bool set_dofs(const rod::ForkDofs& dofs, double switch_off_time) = 0;
  virtual stepping::StepControl& step_control() = 0;

  virtual int coordinates() const = 0;        ///< number of strain coordinates; 0 for a rigid tool
  virtual double length() const = 0;          ///< rest length [m]
  virtual double elastic_energy() const = 0;  ///< [J]
  virtual double energy_added() const = 0;    ///< energy added by integration errors since the grasp [J]
  virtual stepping::StepEstimates take_estimates() = 0;
  /// Saves or restores the whole state between two steps, including the integrator's history and the estimates. It is
  /// restored into a hold made for the same grasp and settings.
  virtual void archive(math::StateArchive& state) = 0;
  /// Fills in the state of the tool. `massless`: whether the object has no mass, so that forces are meaningless.
  virtual void describe(bool massless, ToolState& state) const = 0;
};

}  // namespace spring_workbench::tools
