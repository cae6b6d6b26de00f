// The handle's motion and the held body's acceleration, at one moment or at several, for each number of coordinates.
#include "equation_of_motion.h"
#include "spring_workbench/math/by_size.h"

namespace spring_workbench::dynamics {

HandleState HeldBody::state_at(const motion::Trajectory& handle, double t) const {
  const motion::BodyRateState m = handle.body_rate_state(t);
  HandleState f;
  f.t = t;
  f.X_WH = m.X;
  f.v_WH_W = m.v_W;
  f.w_WH_H = m.w_B;
  f.alpha_WH_H = m.alpha_B;
  f.proper_acceleration_H.noalias() = m.X.linear().transpose() * (m.a_W + gravity_ * Vector3d::UnitZ());
  couplings_.find_relative_motions(handle, t, f.relative_motions);
  return f;
}

HandleStates HeldBody::state_at(const motion::Trajectory& handle, const math::Pack& t) const {
  HandleStates f;
  f.t = t;
  f.of_H = handle.body_frame_rates(t, gravity_);
  couplings_.find_relative_motions(handle, t, f.relative_motions);
  return f;
}

HandleState HandleStates::at(int i) const {
  HandleState f;
  f.t = math::lane(t, i);
  f.X_WH.linear() = math::matrix(of_H.R_WB, i);
  f.w_WH_H = math::vector(of_H.w_B, i);
  f.alpha_WH_H = math::vector(of_H.alpha_B, i);
  f.proper_acceleration_H = math::vector(of_H.a_B, i);
  f.v_WH_W = f.X_WH.linear() * math::vector(of_H.v_B, i);
  f.relative_motions = Couplings::lane(relative_motions, i);
  return f;
}

template <int n>
Eigen::Matrix<double, n, 1> HeldBody::acceleration(const HandleState& h, const Eigen::Matrix<double, n, 1>& q,
                                                   const Eigen::Matrix<double, n, 1>& q_dot) const {
  const HandleRates<double> forcing{h.t,
                                    {math::mat3x3(h.X_WH.linear()), math::zero<double>(), math::vec3(h.w_WH_H),
                                     math::vec3(h.alpha_WH_H), math::vec3(h.proper_acceleration_H)},
                                    h.relative_motions};
  Eigen::Matrix<double, n, 1> q_ddot;
  accelerate<n>(forcing, q.data(), q_dot.data(), q_ddot.data());
  return q_ddot;
}

template <int n>
SPRING_WORKBENCH_WIDE void HeldBody::acceleration(const HandleStates& h, const math::Pack* q, const math::Pack* q_dot,
                                                  math::Pack* q_ddot) const {
  accelerate<n, math::Pack>(h, q, q_dot, q_ddot);
}

#define SPRING_WORKBENCH_FOR_SIZE(n)                                                                     \
  template Eigen::Matrix<double, n, 1> HeldBody::acceleration<n>(                                        \
      const HandleState&, const Eigen::Matrix<double, n, 1>&, const Eigen::Matrix<double, n, 1>&) const; \
  template void HeldBody::acceleration<n>(const HandleStates&, const math::Pack*, const math::Pack*, math::Pack*) const;
SPRING_WORKBENCH_FOR_SIZE(1)
SPRING_WORKBENCH_FOR_SIZE(2)
SPRING_WORKBENCH_FOR_SIZE(3)
SPRING_WORKBENCH_FOR_SIZE(4)
SPRING_WORKBENCH_FOR_SIZE(5)
SPRING_WORKBENCH_FOR_SIZE(6)
#undef SPRING_WORKBENCH_FOR_SIZE

rod::StrainVector HeldBody::acceleration(const HandleState& h, const rod::StrainVector& q,
                                         const rod::StrainVector& q_dot) const {
  return math::by_size(size(), [&](auto size) -> rod::StrainVector {
    constexpr int n = decltype(size)::value;
    return acceleration<n>(h, Eigen::Matrix<double, n, 1>(q), Eigen::Matrix<double, n, 1>(q_dot));
  });
}

}  // namespace spring_workbench::dynamics
