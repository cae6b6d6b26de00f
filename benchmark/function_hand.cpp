#include "benchmark/function_hand.h"

namespace spring_workbench::benchmark {

motion::OwnAxesMotion FunctionHand::in_own_axes(double t) const {
  const HandleMotion<double> handle = handle_motion(scene_, t);
  motion::OwnAxesMotion m;
  m.X.linear() = math::matrix(handle.R_WH, 0);
  m.X.translation() = math::vector(handle.p_W);
  m.v_W = math::vector(handle.v_W);
  m.a_W = math::vector(handle.a_W);
  m.w_B = math::vector(handle.w_H);
  m.alpha_B = math::vector(handle.alpha_H);
  return m;
}

motion::FrameForcing<math::Pack> FunctionHand::forcing(const math::Pack& t, double gravity) const {
  HandleMotion<math::Pack> handle;
  handle_motion(scene_, t, handle);
  handle.a_W.z += gravity;
  return {handle.R_WH, math::transposed(handle.R_WH, handle.v_W), handle.w_H, handle.alpha_H,
          math::transposed(handle.R_WH, handle.a_W)};
}

}  // namespace spring_workbench::benchmark
