// The motion of the handle as the equation of motion needs it.
#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::dynamics {

HandleForcing HeldBody::forcing(const motion::FrameMotion& handle, double t) const {
  const motion::OwnAxesMotion m = handle.in_own_axes(t);
  HandleForcing f;
  f.t = t;
  f.X_WH = m.X;
  f.v_WH_W = m.v_W;
  f.angular_velocity = m.w_B;
  f.angular_acceleration = m.alpha_B;
  f.acceleration_less_gravity.noalias() = m.X.linear().transpose() * (m.a_W + gravity_ * Vector3d::UnitZ());
  couplings_.find_relative_motions(handle, t, f.seen);
  return f;
}

HandleForcings HeldBody::forcing(const motion::FrameMotion& handle, const math::Pack& t) const {
  HandleForcings f;
  f.t = t;
  f.of_H = handle.forcing(t, gravity_);
  couplings_.find_relative_motions(handle, t, f.seen);
  return f;
}

HandleForcing HandleForcings::at(int i) const {
  HandleForcing f;
  f.t = math::lane(t, i);
  f.X_WH.linear() = math::matrix(of_H.R_WB, i);
  f.angular_velocity = math::vector(of_H.w_B, i);
  f.angular_acceleration = math::vector(of_H.alpha_B, i);
  f.acceleration_less_gravity = math::vector(of_H.a_B, i);
  f.v_WH_W = f.X_WH.linear() * math::vector(of_H.v_B, i);
  f.seen = Couplings::lane(seen, i);
  return f;
}

}  // namespace spring_workbench::dynamics
