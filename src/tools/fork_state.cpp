// The fork as one of several tools on an object, its changes while it holds one, and its state as reported.
#include "fork_body.h"
#include "spring_workbench/math/moving_frames.h"
#include "spring_workbench/tools/calibration.h"

namespace spring_workbench::tools {

const dynamics::Coupling& ForkBody::coupling() {
  coupling_.set_strain(held_.full_state(state_.t, state_.strain).q);
  return coupling_;
}

void ForkBody::stop_leading() {
  if (!held_.coupled()) return;
  state_.pull_W = pull();
  held_.detach_beyond(0);
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
  const motion::BodyRateState A = state_.proxy.motion(hand_, t).body_rate_state(t);
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

rod::PerDof ForkBody::fitting_stiffness(const rod::ForkSettings& fork, double gravity, const ObjectGoal& goal) const {
  return calibrated_stiffness(fork.shape, length(), held_.body(), gravity, goal);
}

bool ForkBody::set_dofs(const rod::ForkDofs& dofs, double switch_off_time) {
  const dynamics::StrainState full = held_.full_state(state_.t, state_.strain);
  state_.strain = held_.set_dofs(dofs, state_.t, switch_off_time, full);
  sleep_ = Sleep();
  return held_.returning();
}

double ForkBody::elastic_energy() const { return held_.elastic_energy(state_.t, state_.strain); }

Wrench ForkBody::rod_load(const motion::MotionState& o) const {
  const Matrix3d I_W = o.X.linear() * held_.body().inertia_O * o.X.linear().transpose();
  const Vector3d& w = o.velocity.angular;
  const Wrench& contact = held_.load();
  const Wrench others = held_.read_couplings(handle(), state_.strain).pull_W;
  return {
      held_.body().mass * (o.acceleration.linear + held_.gravity() * Vector3d::UnitZ()) - contact.force - others.force,
      I_W * o.acceleration.angular + w.cross(I_W * w) - contact.moment - others.moment};
}

void ForkBody::describe_bound(ToolState& state) const {
  if (state_.stepping.bounded) state.error_bound = state_.stepping.error_bound;
}

void ForkBody::describe(bool massless, ToolState& f) const {
  const dynamics::StrainState full = held_.full_state(state_.t, state_.strain);
  const rod::ShapeModel& shape = held_.shape();
  f.strain = full.q;
  describe_bound(f);
  f.X_WH = hand_pose();
  f.X_WH_proxy = handle().X_WH;
  f.stretch = shape.extension(full.q);
  f.torsion = shape.torsion_angle(full.q);
  const RigidTransform X_HE_bent = shape.section(full.q, shape.length());
  f.bend = X_HE_bent.translation().head<2>();
  f.X_WE = f.X_WH_proxy * X_HE_bent;
  const motion::MotionState o = object();
  f.V_WE_W = math::shifted(o.velocity, f.X_WE.translation() - o.X.translation());
  f.elastic_energy = elastic_energy();
  if (massless) return;
  f.kinetic_energy = held_.kinetic_energy(o.velocity, o.X.linear());
  const auto [force, moment] = pull();
  f.tip_wrench_W.force = force;
  f.tip_wrench_W.moment = moment + (o.X.translation() - f.X_WE.translation()).cross(force);
  const Vector3d at_handle = moment + (o.X.translation() - f.X_WH_proxy.translation()).cross(force);
  const Matrix3d R_HW = f.X_WH_proxy.linear().transpose();
  f.handle_wrench_H.force = -(R_HW * force);
  f.handle_wrench_H.moment = -(R_HW * at_handle);
}

}  // namespace spring_workbench::tools
