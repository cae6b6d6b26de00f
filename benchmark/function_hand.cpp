#include "benchmark/function_hand.h"

namespace spring_workbench::benchmark {

motion::BodyRateState FunctionHand::body_rate_state(double t) const {
  const auto& [state, acceleration] = handle_motion(scene_, t);
  motion::BodyRateState m;
  m.X.linear() = state.R_WT;
  m.X.translation() = state.p_WT;
  m.v_W = state.v_WT_W;
  m.a_W = acceleration.a_WT_W;
  m.w_B = state.w_WT_T;
  m.alpha_B = acceleration.alpha_WT_T;
  return m;
}

motion::BodyFrameRates<math::Pack> FunctionHand::body_frame_rates(const math::Pack& t, double gravity) const {
  motion::BodyFrameRates<math::Pack> all;
  for (int i = 0; i < math::pack_size; ++i) {
    const motion::BodyRateState m = body_rate_state(t[i]);
    const Matrix3d R_BW = m.X.linear().transpose();
    math::set_lane(all.R_WB, i, math::mat3x3(m.X.linear()));
    math::set_lane(all.v_B, i, math::vec3(R_BW * m.v_W));
    math::set_lane(all.w_B, i, math::vec3(m.w_B));
    math::set_lane(all.alpha_B, i, math::vec3(m.alpha_B));
    math::set_lane(all.a_B, i, math::vec3(R_BW * (m.a_W + gravity * Vector3d::UnitZ())));
  }
  return all;
}

}  // namespace spring_workbench::benchmark
