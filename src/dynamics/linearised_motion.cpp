#include "spring_workbench/dynamics/linearised_motion.h"

#include <algorithm>

#include "accelerations.h"
#include "constants.h"
#include "spring_workbench/math/by_size.h"
#include "spring_workbench/math/side_by_side.h"
#include "spring_workbench/rod/difference_steps.h"

namespace spring_workbench::dynamics {
LinearisedMotion::LinearisedMotion(const HeldBody& body, const HandleState& handle, const rod::StrainVector& q)
    : M(body.mass_matrix(handle.t, q)) {
  const HeldBody::Springs springs = body.springs(handle, q);
  K = springs.K;
  D = springs.D;
}

LinearisedMotion::LinearisedMotion(const HeldBody& body, const HandleState& handle, const HandleStates& moment,
                                   const StrainState& state, const rod::StrainVector& q_ddot)
    : LinearisedMotion(body, handle, state.q) {
  const rod::StrainVector dq = rod::difference_steps(strain_difference * body.units(), state.q),
                          dv = rod::difference_steps(rate_difference * body.units(), state.q_dot);
  math::by_size(body.size(), [&](auto size) {
    constexpr int n = decltype(size)::value;
    const Eigen::Matrix<double, n, 1> a = q_ddot;
    for (int first = 0; first < 2 * n; first += math::pack_size) {  // strains, then rates: one in each lane
      auto q = math::side_by_side<n, math::pack_size>(state.q),
           q_dot = math::side_by_side<n, math::pack_size>(state.q_dot);
      const int used = std::min(math::pack_size, 2 * n - first);
      for (int k = 0; k < used; ++k) {
        const int j = first + k;
        j < n ? q(j, k) += dq[j] : q_dot(j - n, k) += dv[j - n];
      }
      const Eigen::Matrix<double, n, math::pack_size> moved = accelerations(body, moment, q, q_dot);
      for (int k = 0; k < used; ++k) {
        const int j = (first + k) % n;
        const bool strain = first + k < n;
        const double step = strain ? q(j, k) - state.q[j] : q_dot(j, k) - state.q_dot[j];
        const Eigen::Matrix<double, n, 1> change = moved.col(k) - a;
        const rod::StrainVector force = M * change;
        rod::StrainMatrix& into = strain ? K : D;
        for (int i = 0; i < n; ++i) into(i, j) -= (force[i] + step * into(i, j)) / step;
      }
    }
  });
}

}  // namespace spring_workbench::dynamics
