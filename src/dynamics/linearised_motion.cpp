#include "spring_workbench/dynamics/linearised_motion.h"

#include "constants.h"
#include "spring_workbench/math/by_size.h"
#include "spring_workbench/rod/difference_steps.h"

namespace spring_workbench::dynamics {
LinearisedMotion::LinearisedMotion(const HeldBody& body, const HandleForcing& handle, const rod::StrainVector& q)
    : M(body.mass_matrix(handle.t, q)) {
  const HeldBody::Springs springs = body.springs(handle, q);
  K = springs.K;
  D = springs.D;
}

LinearisedMotion::LinearisedMotion(const HeldBody& body, const HandleForcing& handle, const HandleForcings& moment,
                                   const StrainState& state, const rod::StrainVector& q_ddot)
    : LinearisedMotion(body, handle, state.q) {
  const rod::StrainVector dq = rod::difference_steps(strain_difference * body.units(), state.q),
                          dv = rod::difference_steps(rate_difference * body.units(), state.q_dot);
  math::by_size(body.size(), [&](auto size) {
    constexpr int n = decltype(size)::value;
    for (int first = 0; first < 2 * n; first += math::pack_size) {  // strains, then rates: one in each lane
      math::Pack q[n], q_dot[n], moved[n];
      for (int i = 0; i < n; ++i) {
        q[i] = state.q[i] + math::Pack{};
        q_dot[i] = state.q_dot[i] + math::Pack{};
      }
      for (int k = 0; k < math::pack_size && first + k < 2 * n; ++k) {
        const int j = first + k;
        j < n ? q[j][k] += dq[j] : q_dot[j - n][k] += dv[j - n];
      }
      body.acceleration<n>(moment, q, q_dot, moved);
      for (int k = 0; k < math::pack_size && first + k < 2 * n; ++k) {
        const int j = (first + k) % n;
        const bool strain = first + k < n;
        const double step = strain ? q[j][k] - state.q[j] : q_dot[j][k] - state.q_dot[j];
        rod::StrainVector force(n);  // times M⁻¹
        for (int i = 0; i < n; ++i) force[i] = moved[i][k] - q_ddot[i];
        (strain ? K : D).col(j) -= (M * force + step * (strain ? K : D).col(j)) / step;
      }
    }
  });
}

ImplicitMatrix::ImplicitMatrix(const LinearisedMotion& motion, double d) {
  const rod::StrainMatrix A = motion.M + d * motion.D + d * d * motion.K;
  scale_ = A.diagonal().cwiseAbs().cwiseMax(motion.M.diagonal()).cwiseSqrt().cwiseInverse();
  lu_.compute(scale_.asDiagonal() * A * scale_.asDiagonal());
}

rod::StrainMatrix ImplicitMatrix::solve(const rod::StrainMatrix& b) const {
  return scale_.asDiagonal() * lu_.solve(rod::StrainMatrix(scale_.asDiagonal() * b));
}

}  // namespace spring_workbench::dynamics
