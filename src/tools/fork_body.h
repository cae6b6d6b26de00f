#pragma once

#include <optional>
#include <utility>

#include "fork_coupling.h"
#include "spring_workbench/stepping/load_response.h"
#include "spring_workbench/tools/tool_hold.h"

namespace spring_workbench::tools {

/// A body held by the fork: strain coordinates, the motion of the hand and, if the coordinates cannot comply with a
/// contact, a proxy handle that lags behind the hand (doc/model.md, "When the fork cannot follow").
class ForkBody : public ToolHold {
 public:
  /// `X_SH`: pose of the fork's fixed end H in the stylus frame S.
  ForkBody(std::size_t index, dynamics::HeldBody held, stepping::StepControl control, double t,
           const RigidTransform& X_SH);

  std::size_t index() const override { return index_; }
  motion::MotionState object() const override;
  bool advance(double h, const Wrench& contact_W) override;
  bool advance_freely(double h, const PathCheck& is_free) override;
  void save(bodies::TrialStart& start) const override { start.keep(state_); }
  void restore(const bodies::TrialStart& start) override;
  void accept() override;
  Response response(double h) const override;
  void correct(double h, const Wrench& change_W) override;
  Matrix6d mobility() const override;
  void add_impulse(const Wrench& impulse_W) override;
  void block(double h) override;
  void follow_rigidly(double h) override;

  double since() const override { return coupling_.key().since; }
  const dynamics::Coupling& coupling() override;
  void lead(const std::vector<dynamics::Attached>& others) override { held_.attach(others); }
  void stop_leading() override;
  void follow(double t, const ToolHold& leader, const motion::MotionState& object) override;
  const motion::MotionSegment& hand() const override { return hand_; }
  const motion::Proxy& proxy() const override { return state_.proxy; }
  void set_load(const Wrench& load_W) override;
  void set_hand(const motion::MotionSegment& hand, double t) override;
  bool sleeps(double h, bool may_fall_asleep) override;
  void advance_at_rest(double h) override { state_.t += h; }

  Wrench spring_pull() const override;
  void regrasp(const RigidTransform& X_WO, const Wrench& pull_W) override;
  RigidTransform slip(double h, const motion::MotionState& object, const Wrench& at_tip_W) override;
  /// Sets the strain rates such that the object's twist is as close to this one as possible.
  void take_twist(const Twist& V_WO_W) override;
  void set_springs(const rod::ForkSettings& fork) override { held_.set_springs(fork); }
  rod::PerDof fitting_stiffness(const rod::ForkSettings& fork, double gravity, const ObjectGoal& goal) const override;
  bool set_dofs(const rod::ForkDofs& dofs, double switch_off_time) override;
  stepping::StepControl& step_control() override { return control_; }
  int coordinates() const override { return held_.size(); }
  double length() const override { return held_.shape().length(); }
  double elastic_energy() const override;

  dynamics::HandleState handle() const;  ///< the proxy handle at present
  RigidTransform hand_pose() const;      ///< the handle in the hand
  /// The object's motion at present, with acceleration.
  motion::MotionState object_with_acceleration() const;

  /// Energy [J] added by integration errors since the grasp: what the object and the fork have gained beyond the work
  /// of hand, gravity, contact and damping. That work is computed by four-point quadrature over each step, so the
  /// result is meaningful if the step resolves the motion (ω·dt below about 1). Nothing is added while a DOF returns to
  /// zero strain.
  double energy_added() const override { return state_.energy_added; }

  /// Fills in the state of the fork. `massless`: whether the object has no mass, so that forces are meaningless.
  void describe(bool massless, ToolState& state) const override;

  stepping::StepEstimates take_estimates() override { return std::exchange(estimates_, {}); }
  void archive(math::StateArchive& state) override;

 protected:  // for tools that replace the rod by another spring
  dynamics::HeldBody& held() { return held_; }
  const dynamics::HeldBody& held() const { return held_; }
  double time() const { return state_.t; }
  const dynamics::StrainState& strain() const { return state_.strain; }
  void describe_bound(ToolState& state) const;
  void set_strain(const dynamics::StrainState& strain) { state_.strain = strain; }

 private:
  /// The part of the state that a trial step changes and that has to be restored. A trial also changes the integrator's
  /// history, the versions and load of the equations, and estimates.
  struct State {
    double t = 0.0;
    dynamics::StrainState strain;
    motion::Proxy proxy;
    double energy_added = 0.0;  ///< [J]
    stepping::StepControl::Memory stepping;
    std::optional<Wrench> pull_W;  ///< wrench on the object at its centre, if it was shared in the last step

    void archive(math::StateArchive& state) { state(t, strain, proxy, energy_added, stepping, pull_W); }
  };
  void take_hand(const motion::MotionSegment& hand) {
    hand_ = hand;
    known_.reset();
  }
  /// Whether the strain can move the object in every direction.
  bool yields_everywhere() const {
    return held_.size() == rod::max_strain_coordinates && load_response_.stops().cols() == 0;
  }
  /// The two parts of mobility(): in the directions in which the strain can move the object, and in the others.
  Matrix6d strain_mobility() const;
  Matrix6d rigid_mobility() const;
  /// Compliance of the proxy to a wrench at the centre of mass over a step, in the directions in which the coordinates
  /// cannot yield: that of a spring and a damper in parallel (doc/model.md, "When the fork cannot follow").
  Matrix6d proxy_compliance(double h) const;
  /// Displacement of the proxy under a wrench over a step: a rotation about the object's centre of mass and a
  /// translation.
  RigidTransform proxy_response(double h, const Wrench& contact_W) const;
  /// Offset of the proxy at the end of a step under a wrench.
  RigidTransform next_offset(double h, const Wrench& contact_W) const;
  rod::StrainMatrix inverse_mass() const;
  /// Wrench of the rod on the object at its centre, world axes: rate of change of its momentum minus gravity and
  /// contact.
  Wrench rod_load(const motion::MotionState& object) const;
  Wrench pull() const { return state_.pull_W ? *state_.pull_W : rod_load(object_with_acceleration()); }
  /// Returns the strain at which the springs exert `pull_W` on the object with orientation `R_WO`; the current strain,
  /// counted as a fallback, if none is found.
  rod::StrainVector strain_under(const Wrench& pull_W, const Matrix3d& R_WO);
  rod::TwistJacobian jacobian_W() const { return jacobian_W(handle().X_WH.linear(), state_.t); }
  rod::TwistJacobian jacobian_W(const Matrix3d& R_WH, double t) const;

  std::size_t index_;
  dynamics::HeldBody held_;
  ForkCoupling coupling_;  ///< used while another tool leads
  stepping::StepControl control_;
  RigidTransform X_SH_;         ///< constant until a regrasp
  motion::MotionSegment hand_;  ///< motion of the handle in the hand
  State state_;
  /// Cache of the last result of object(), with the state for which it is valid.
  struct Known {
    double t;
    long version;  ///< of the equations
    dynamics::StrainState strain;
    motion::Proxy proxy;
    motion::MotionState object;
  };
  mutable std::optional<Known> known_;
  stepping::LoadResponse load_response_;
  double added_ = 0.0;  ///< energy added by the last advance(), which may turn out to be a trial [J]
  stepping::StepEstimates trial_,
      estimates_;  ///< estimates: of the last advance(), and the total of accepted ones
  /// Conditions under which an object at rest stays at rest.
  struct Sleep {
    long version = -1;  ///< version of the equations; −1: awake
    RigidTransform X_WH = RigidTransform::Identity();
    void archive(math::StateArchive& state) { state(version, X_WH); }
  };
  Sleep sleep_;
  Wrench load_W_;
};

}  // namespace spring_workbench::tools
