#include "range_stop.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "constants.h"
#include "energy_account.h"
#include "spring_workbench/dynamics/linearised_motion.h"
#include "spring_workbench/rod/difference_steps.h"

namespace spring_workbench::stepping {
namespace {

double range_used(const dynamics::HeldBody& body, double t, const rod::StrainVector& q) {
  return body.shape().range_used(body.full_state(t, {q, rod::StrainVector::Zero(q.size())}).q);
}

}  // namespace

rod::StrainVector range_slope(const dynamics::HeldBody& body, double t, const rod::StrainVector& q) {
  rod::StrainVector g(q.size());
  const rod::StrainVector dq = rod::difference_steps(range_difference * body.units(), q);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    rod::StrainVector up = q, down = q;
    up[i] += dq[i];
    down[i] -= dq[i];
    g[i] = (range_used(body, t, up) - range_used(body, t, down)) / (up[i] - down[i]);
  }
  return g;
}

void stop_at_range(const dynamics::HeldBody& body, const dynamics::HandleState& handle, double h,
                   const dynamics::StrainState& begin, dynamics::StrainState& end) {
  const double t = handle.t;
  const auto used = [&](const rod::StrainVector& q) { return range_used(body, t, q); };
  const auto slope = [&](const rod::StrainVector& q) { return range_slope(body, t, q); };
  const auto kinetic = [&](const dynamics::StrainState& s) {
    return 0.5 * s.q_dot.dot(body.mass_matrix(t, s.q) * s.q_dot);
  };
  // Against a contact's load, which holds for one step, only what moves counts.
  const double moving_before = body.loaded() ? kinetic(end) : 0.0;
  const dynamics::LinearisedMotion motion(body, handle, begin.q);
  std::optional<EnergyGain> energy;
  if (!body.loaded()) energy.emplace(body, handle, begin);
  const auto gained = [&](const dynamics::StrainState& s) {
    return energy ? (*energy)(s) : kinetic(s) - moving_before;
  };
  const math::ImplicitMatrix step = motion.implicit(h);
  // Not further in than it is already.
  const double target = std::max(inside, used(begin.q));
  rod::StrainVector q = end.q;
  for (int i = 0; i < most_iterations && !(used(q) < 1.0); ++i) {
    const rod::StrainVector g = slope(q), moved = step.solve(g);
    q -= (used(q) - target) / g.dot(moved) * moved;
  }
  // It adds nothing, whatever the step has gained out of the range.
  const auto allowed = [&](const rod::StrainVector& at) {
    return used(at) < 1.0 && gained({at, 0.0 * end.q_dot}) <= 0.0;
  };
  if (!allowed(q)) {
    double shortest = 0.0, longest = 1.0;
    for (int k = 0; k < most_bisections; ++k) {
      const double part = 0.5 * (shortest + longest);
      (allowed(begin.q + part * (end.q - begin.q)) ? shortest : longest) = part;
    }
    q = begin.q + shortest * (end.q - begin.q);
  }
  end.q = q;
  // Compressed and wound up at once, it is at two stops.
  const Eigen::LLT<rod::StrainMatrix> mass(motion.M);
  for (int i = 0; i < most_iterations && !end.q_dot.isZero(0.0); ++i) {
    const double fastest = end.q_dot.cwiseQuotient(body.units()).cwiseAbs().maxCoeff();
    const rod::StrainVector on = q + range_difference / fastest * end.q_dot;
    if (!(used(on) > inside)) break;
    const rod::StrainVector g = slope(on), moved = mass.solve(g);
    const double out = g.dot(end.q_dot);
    if (!(out > 0.0)) break;
    end.q_dot -= out / g.dot(moved) * moved;
  }
  // What the strain gained on its way back, the rates lose.
  const double moving = kinetic(end), excess = gained(end);
  if (excess > 0.0 && moving > 0.0) end.q_dot *= std::sqrt(std::max(0.0, 1.0 - excess / moving));
}

double slow_down(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t, double h,
                 const dynamics::StrainState& begin, dynamics::StrainState& end) {
  const double added = energy_added(body, handle, t, h, begin, end);
  if (!(added > 0.0) || body.loaded() || body.coupled()) return added;
  const double kinetic = 0.5 * end.q_dot.dot(body.mass_matrix(t + h, end.q) * end.q_dot);
  if (kinetic > 0.0) end.q_dot *= std::sqrt(std::max(0.0, 1.0 - added / kinetic));
  return energy_added(body, handle, t, h, begin, end);
}

}  // namespace spring_workbench::stepping
