#pragma once

#include <optional>

#include "fork_body.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::tools {

/// The spring and damper of the tool `spring` between the hand and the centre of mass. It exerts no moment, and the
/// force F = −(k (r − L) + c ṙ) n, where r n is the vector from the hand to the centre.
class SpringCoupling final : public dynamics::Coupling {
 public:
  /// `rest_length` L [m] > 0; `since`: time of the grasp [s].
  SpringCoupling(double rest_length, double since) : rest_length_(rest_length), since_(since) {}

  void set(double stiffness, double damping);
  void set_rest_length(double length);
  double rest_length() const { return rest_length_; }
  double stiffness() const { return k_; }

  Key key() const override { return {since_, version_}; }
  void pull(const double& t, const dynamics::RelativeMotion<double>& A_O, dynamics::Pull<double>& pull) const override;
  void pull(const math::Pack& t, const dynamics::RelativeMotion<math::Pack>& A_O,
            dynamics::Pull<math::Pack>& pull) const override;
  Springs springs(double t, const dynamics::RelativeMotion<double>& A_O) const override;
  void archive(math::StateArchive& state) { state(rest_length_, since_, version_, k_, c_); }

 private:
  template <typename S>
  struct Span;  ///< from the hand to the object's centre
  template <typename S>
  Span<S> span(const dynamics::RelativeMotion<S>& A_O) const;
  template <typename S>
  void pull_of(const dynamics::RelativeMotion<S>& A_O, dynamics::Pull<S>& pull) const;

  double rest_length_, since_;
  long version_ = 0;
  double k_ = 0.0, c_ = 0.0;  ///< [N/m], [N·s/m]
};

/// A body that no tool holds and that couplings move: six coordinates without springs …
dynamics::HeldBody unheld(const scene::Body& body, double gravity);
/// … relative to a frame at rest, for which an object at `X_WO` has zero strain.
motion::MotionSegment frame_at_rest(const RigidTransform& X_WO);

/// An object held by the tool `spring` (doc/model.md, "Tools"), about which it can turn freely.
class SpringBody final : public ForkBody {
 public:
  /// The mass of `body` must be > 0. `rest_length` [m] > 0; uses stiffness and damping of `stretch`.
  SpringBody(std::size_t index, const scene::Body& body, double gravity, const RigidTransform& X_WO,
             stepping::StepControl control, double t, double rest_length, const rod::ForkSettings& fork);

  const dynamics::Coupling& coupling() override { return spring_; }
  void lead(const std::vector<dynamics::Attached>& others) override;
  void stop_leading() override { held().detach_beyond(1); }
  void follow(double t, const ToolHold& leader, const motion::MotionState& object) override;
  const motion::MotionSegment& hand() const override { return hand_; }

  void set_hand(const motion::MotionSegment& hand, double t) override;
  bool sleeps(double, bool) override { return false; }
  Wrench spring_pull() const override;
  /// Changes the rest length, since the spring can only pull along its line.
  void regrasp(const RigidTransform& X_WO, const Wrench& pull_W) override;
  RigidTransform slip(double h, const motion::MotionState& object, const Wrench& at_tip_W) override;
  void set_springs(const rod::ForkSettings& fork) override;
  rod::PerDof fitting_stiffness(const rod::ForkSettings& fork, double gravity, const ObjectGoal& goal) const override;
  bool set_dofs(const rod::ForkDofs&, double) override { return false; }
  double length() const override { return spring_.rest_length(); }
  double elastic_energy() const override { return reading().springs.energy; }
  void describe(bool massless, ToolState& state) const override;
  void archive(math::StateArchive& state) override;

 private:
  struct Reading {
    Vector3d d;  ///< from the hand to the object's centre, world axes [m]
    Wrench pull_W;
    dynamics::Coupling::Springs springs;
  };
  Reading reading() const;

  SpringCoupling spring_;
  motion::MotionSegment rest_, hand_;
  std::optional<Vector3d> slipped_W_;  ///< force on the object in a step in which the tool slipped [N]
};

}  // namespace spring_workbench::tools
