#include "spring_workbench/dynamics/linearised_motion.h"

namespace spring_workbench::dynamics {
namespace {

// Of one-sided differences, which leave half of the digits. With larger ones, methods that treat the derivatives as
// exact lose their order if steps are short.
constexpr double strain_difference = 3e-8;  ///< in units of the coordinate
constexpr double rate_difference = 3e-7;    ///< in units of the coordinate [1/s]

}  // namespace

LinearisedMotion::LinearisedMotion(const HeldBody& body, const HandleForcing& handle, const rod::StrainVector& q)
    : M(body.mass_matrix(handle.t, q)) {
  const HeldBody::Springs springs = body.springs(handle, q);
  K = springs.K;
  D = springs.D;
}

LinearisedMotion::LinearisedMotion(const HeldBody& body, const HandleForcing& handle, const StrainState& state,
                                   const rod::StrainVector& q_ddot)
    : LinearisedMotion(body, handle, state.q) {
  const rod::StrainMatrix stiffness = K, damping = D;
  const rod::StrainVector units = body.units();
  StrainState moved = state;
  for (int j = 0; j < body.size(); ++j) {
    moved.q[j] += strain_difference * units[j];
    const double step_q = moved.q[j] - state.q[j];
    rod::StrainVector force = M * (body.acceleration(handle, moved.q, state.q_dot) - q_ddot);
    force += stiffness.col(j) * step_q;
    K.col(j) -= force / step_q;
    moved.q[j] = state.q[j];

    moved.q_dot[j] += rate_difference * units[j];
    const double step_v = moved.q_dot[j] - state.q_dot[j];
    force = M * (body.acceleration(handle, state.q, moved.q_dot) - q_ddot);
    force += damping.col(j) * step_v;
    D.col(j) -= force / step_v;
    moved.q_dot[j] = state.q_dot[j];
  }
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
