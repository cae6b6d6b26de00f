// The acceleration of the held body at one moment or at several, for each number of coordinates.
#include "equation_of_motion.h"
#include "spring_workbench/math/by_size.h"

namespace spring_workbench::dynamics {

template <int n>
Eigen::Matrix<double, n, 1> HeldBody::acceleration(const HandleForcing& h, const Eigen::Matrix<double, n, 1>& q,
                                                   const Eigen::Matrix<double, n, 1>& q_dot) const {
  const ForcingOf<double> forcing{
      h.t,
      {math::three_by_three(h.X_WH.linear()), math::none<double>(), math::three(h.angular_velocity),
       math::three(h.angular_acceleration), math::three(h.acceleration_less_gravity)},
      h.seen};
  Eigen::Matrix<double, n, 1> q_ddot;
  accelerate<n>(forcing, q.data(), q_dot.data(), q_ddot.data());
  return q_ddot;
}

template <int n>
SPRING_WORKBENCH_WIDE void HeldBody::acceleration(const HandleForcings& h, const math::Pack* q, const math::Pack* q_dot,
                                                  math::Pack* q_ddot) const {
  accelerate<n, math::Pack>(h, q, q_dot, q_ddot);
}

#define SPRING_WORKBENCH_FOR_SIZE(n)                                                                                \
  template Eigen::Matrix<double, n, 1> HeldBody::acceleration<n>(                                                   \
      const HandleForcing&, const Eigen::Matrix<double, n, 1>&, const Eigen::Matrix<double, n, 1>&) const;          \
  template void HeldBody::acceleration<n>(const HandleForcings&, const math::Pack*, const math::Pack*, math::Pack*) \
      const;
SPRING_WORKBENCH_FOR_SIZE(1)
SPRING_WORKBENCH_FOR_SIZE(2)
SPRING_WORKBENCH_FOR_SIZE(3)
SPRING_WORKBENCH_FOR_SIZE(4)
SPRING_WORKBENCH_FOR_SIZE(5)
SPRING_WORKBENCH_FOR_SIZE(6)
#undef SPRING_WORKBENCH_FOR_SIZE

rod::StrainVector HeldBody::acceleration(const HandleForcing& h, const rod::StrainVector& q,
                                         const rod::StrainVector& q_dot) const {
  return math::by_size(size(), [&](auto size) -> rod::StrainVector {
    constexpr int n = decltype(size)::value;
    return acceleration<n>(h, Eigen::Matrix<double, n, 1>(q), Eigen::Matrix<double, n, 1>(q_dot));
  });
}

}  // namespace spring_workbench::dynamics
