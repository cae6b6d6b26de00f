#include "range_stop.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "implicit_integrators.h"

namespace spring_workbench::dynamics {
namespace {

constexpr double inside = 1.0 - 1e-9;  ///< of the range: where a strain that left it is put
constexpr double difference = 1e-6;    ///< over the length, for the range's slope
constexpr int most_iterations = 20;    ///< of Newton's method; the range is convex
constexpr int halvings = 50;           ///< of the way back to the begin, where that leads nowhere

}  // namespace

void stop_at_range(const HeldBody& body, double t, double h, const StrainState& begin, StrainState& end) {
  const auto used = [&](const rod::StrainVector& q) {
    return body.shape().range_used(body.full_state(t, {q, rod::StrainVector::Zero(q.size())}).q);
  };
  const auto slope = [&](const rod::StrainVector& q) {
    rod::StrainVector g(q.size());
    const double dq = difference / body.shape().length();
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      rod::StrainVector up = q, down = q;
      up[i] += dq;
      down[i] -= dq;
      g[i] = (used(up) - used(down)) / (2.0 * dq);
    }
    return g;
  };
  const auto kinetic = [&](const StrainState& s) { return s.q_dot.dot(body.mass_matrix(t, s.q) * s.q_dot); };
  const double before = kinetic(end);
  const LinearisedMotion motion(body, t, begin.q);
  const ImplicitMatrix step(motion, h);
  rod::StrainVector q = end.q, g;
  for (int i = 0; i < most_iterations && !(used(q) < 1.0); ++i) {
    g = slope(q);
    const rod::StrainVector moved = step.solve(g);
    q -= (used(q) - inside) / g.dot(moved) * moved;
  }
  if (!(used(q) < 1.0)) {
    double shortest = 0.0, longest = 1.0;
    for (int k = 0; k < halvings; ++k) {
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

}  // namespace spring_workbench::dynamics
