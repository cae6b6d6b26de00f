#pragma once

#include <optional>

#include "spring_workbench/dynamics/coupling.h"
#include "spring_workbench/motion/pose_track.h"
#include "spring_workbench/rod/settings.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/tool_state.h"

namespace spring_workbench::tools {

/// The nearest point at which the z axis of a hand meets a body or the bench.
struct AxisHit {
  double distance = 0.0;  ///< distance from the hand along the axis [m]; as far as was looked if nothing is hit
  const scene::Body* body = nullptr;          ///< body that is hit; null: the bench plane or nothing
  const scene::Material* material = nullptr;  ///< its material; null: nothing is hit
  // The following are in the object frame of the body:
  Vector3d point_O = Vector3d::Zero();   ///< point at which the axis meets it [m]
  Vector3d normal_O = Vector3d::Zero();  ///< outward normal of the surface there
};

/// The tool `spring_probe` while it touches something (doc/model.md, "The probe"): a spring along the probe's axis in
/// series with the spring of the material, whose stiffness it measures. It can only push, without friction at its tip.
/// On a movable body it is a coupling with a damper parallel to both springs; the surface is the tangent plane at the
/// first point of contact.
class Probe final : public dynamics::Coupling {
 public:
  /// Starts a touch, at time `now` [s], of the body that is `touched.distance` in front of the hand, which must be less
  /// than the probe's `length` [m]. Keeps no reference to `fork`.
  Probe(double length, const rod::ForkSettings& fork, const AxisHit& touched, double now);

  /// Updates the point of contact on the same body.
  void touch(const AxisHit& touched);
  void set_springs(const rod::ForkSettings& fork);
  /// Sets the hand's motion, which must cover the following steps.
  void set_hand(const motion::MotionSegment& hand) { hand_ = hand; }
  const motion::MotionSegment& hand() const { return hand_; }

  Key key() const override { return {since_, version_}; }
  void pull(const double& t, const dynamics::RelativeMotion<double>& A_O, dynamics::Pull<double>& pull) const override;
  void pull(const math::Pack& t, const dynamics::RelativeMotion<math::Pack>& A_O,
            dynamics::Pull<math::Pack>& pull) const override;
  Springs springs(double t, const dynamics::RelativeMotion<double>& A_O) const override;
  /// Follows the body to time `t` [s]; `object`: its motion at that time.
  void follow(double t, const motion::MotionState& object);

  /// Sets the force to the equilibrium of the springs, for a body that does not move.
  void press();

  double elastic_energy() const { return 0.5 * force_ * depth_; }
  const scene::Body* body() const { return body_; }
  /// Saves or restores everything that changes while it touches the same body.
  void archive(math::StateArchive& state) {
    state(since_, version_, k_, series_, c_, hand_, point_O_, normal_O_, depth_, force_);
  }
  /// Fills in the state of the tool. `X_WH`: pose of the hand.
  void describe(const RigidTransform& X_WH, ToolState& state) const;

 private:
  /// State of the contact between tip and surface.
  template <typename S>
  struct Touch {
    S depth, rate;        ///< depth that the tip would have if both springs were rigid [m], and its rate [m/s]
    math::Vec3<S> arm;    ///< contact point relative to the object's centre
    math::Vec3<S> speed;  ///< velocity of the object there
    S force;
  };
  template <typename S>
  Touch<S> touch_of(const dynamics::RelativeMotion<S>& A_O) const;
  template <typename S>
  void pull_of(const dynamics::RelativeMotion<S>& A_O, dynamics::Pull<S>& pull) const;

  double length_;
  const scene::Body* body_;
  scene::Material material_;
  double since_;
  long version_ = 0;
  double k_ = 0.0, series_ = 0.0;  ///< stiffness of the probe, and of probe and material in series [N/m]
  double c_ = 0.0;
  motion::MotionSegment hand_;
  Vector3d point_O_, normal_O_;
  double depth_ = 0.0;  ///< at present [m]
  double force_ = 0.0;  ///< [N]
};

}  // namespace spring_workbench::tools
