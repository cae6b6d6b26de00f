// The fork as one of several tools on an object.
#include "fork_body.h"

namespace spring_workbench::tools {

const dynamics::Coupling& ForkBody::coupling() {
  coupling_.set_strain(held_.full_state(state_.t, state_.strain).q);
  return coupling_;
}

void ForkBody::stop_leading() {
  if (!held_.coupled()) return;
  state_.pull_W = pull();
  held_.detach(0);
}

void ForkBody::follow(double t, const ToolHold& leader, const motion::MotionState& object) {
  sleep_ = Sleep();
  state_.stepping = stepping::StepControl::Memory();
  state_.t = t;
  const bool rigid = held_.size() < rod::max_strain_coordinates;
  state_.proxy = rigid ? leader.proxy() : motion::Proxy();
  if (held_.size() == 0) {  // the leader is rigid, too: this one exerts no force, and its proxy follows the object
    state_.pull_W = Wrench();
    const RigidTransform by = object.X * held_.object(handle(), held_.zero_state()).X.inverse();
    state_.proxy.place(by * state_.proxy.offset(), state_.proxy.rate());
    return;
  }
  const motion::OwnAxesMotion A = state_.proxy.motion(hand_, t).in_own_axes(t);
  const dynamics::RelativeMotion<double> A_O = dynamics::relative_motion(A, object);
  dynamics::Pull<double> pull{};
  coupling_.pull(t, A_O, pull);
  const Matrix3d& R_WA = A.X.linear();
  state_.pull_W = Wrench{R_WA * math::vector(pull.force), R_WA * math::vector(pull.moment)};
  const ForkCoupling::Following following = coupling_.follow(A_O);
  state_.strain = following.strain;
  state_.proxy.place(A.X * following.X_HP * A.X.inverse() * state_.proxy.offset(), state_.proxy.rate());
  if (held_.returning() && held_.drop_finished_returns(t) && held_.size() == 0) state_.strain = held_.zero_state();
}

}  // namespace spring_workbench::tools
