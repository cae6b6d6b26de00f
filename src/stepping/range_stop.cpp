#include "range_stop.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "constants.h"
#include "spring_workbench/dynamics/linearised_motion.h"

namespace spring_workbench::stepping {

void stop_at_range(const dynamics::HeldBody& body, const dynamics::HandleForcing& handle, double h,
                   const dynamics::StrainState& begin, dynamics::StrainState& end) {
  const double t = handle.t;
  const auto used = [&](const rod::StrainVector& q) {
    return body.shape().range_used(body.full_state(t, {q, rod::StrainVector::Zero(q.size())}).q);
  };
  const auto slope = [&](const rod::StrainVector& q) {
    rod::StrainVector g(q.size());
    const double dq = range_difference / body.shape().length();
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      rod::StrainVector up = q, down = q;
      up[i] += dq;
      down[i] -= dq;
      g[i] = (used(up) - used(down)) / (2.0 * dq);
    }
    return g;
  };
  const auto kinetic = [&](const dynamics::StrainState& s) { return s.q_dot.dot(body.mass_matrix(t, s.q) * s.q_dot); };
  const double before = kinetic(end);
  const dynamics::LinearisedMotion motion(body, handle, begin.q);
  const dynamics::ImplicitMatrix step(motion, h);
  rod::StrainVector q = end.q, g;
  for (int i = 0; i < most_iterations && !(used(q) < 1.0); ++i) {
    g = slope(q);
    const rod::StrainVector moved = step.solve(g);
    q -= (used(q) - inside) / g.dot(moved) * moved;
  }
  if (!(used(q) < 1.0)) {
    double shortest = 0.0, longest = 1.0;
    for (int k = 0; k < most_bisections; ++k) {
      const double part = 0.5 * (shortest + longest);
      (used(begin.q + part * (end.q - begin.q)) < 1.0 ? shortest : longest) = part;
    }
    q = begin.q + shortest * (end.q - begin.q);
    g = slope(q);
  }
  end.q = q;
  const rod::StrainVector moved = motion.M.llt().solve(g);
  const double out = g.dot(end.q_dot);
  if (out > 0.0) end.q_dot -= out / g.dot(moved) * moved;
  const double after = kinetic(end);
  if (after > before) end.q_dot *= std::sqrt(before / after);
}

}  // namespace spring_workbench::stepping
