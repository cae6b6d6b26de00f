#include "implicit_integrators.h"

#include <algorithm>
#include <cmath>

#include "accelerations.h"
#include "constants.h"
#include "spring_workbench/dynamics/linearised_motion.h"
#include "spring_workbench/math/by_size.h"
#include "spring_workbench/math/rodas.h"
#include "spring_workbench/math/side_by_side.h"

namespace spring_workbench::dynamics {
StepEstimate ImplicitEuler::step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                                 StrainState& state) {
  const HandleState end = body.state_at(handle, t + h);
  const rod::StrainVector a_begin = body.acceleration(body.state_at(handle, t), state.q, state.q_dot);
  StrainState next = state;
  rod::StrainVector a = body.acceleration(end, next.q, next.q_dot);
  const LinearisedMotion& motion = last_.emplace(body, end, body.state_at(handle, t + h + math::Pack{}), next, a);
  const math::ImplicitMatrix matrix = motion.implicit(h);
  double last_change = 0.0, first_change = 0.0;
  bool converged = false;
  for (int i = 0; i < max_newton_steps && !converged; ++i) {
    // q̇ is the unknown, q = q₀ + h q̇: residual q̇ − q̇₀ − h q̈.
    const rod::StrainVector off_q = state.q + h * next.q_dot - next.q;  // of the first iterate only
    const rod::StrainVector change =
        matrix.solve(motion.M * (state.q_dot - next.q_dot + h * a) - h * (motion.K * off_q));
    next.q_dot += change;
    next.q = state.q + h * next.q_dot;
    a = body.acceleration(end, next.q, next.q_dot);
    const double size = motion.size(change);
    if (i == 0) first_change = size;
    const double rate = i > 1 ? std::min(size / last_change, 1.0) : 1.0;
    const double left = std::min(1.0, rate / (1.0 - rate)) * size;  // to be changed by iterations after this one
    converged = left <= newton_tolerance * (first_change + motion.size(next.q_dot) + motion.size(next.q) / h);
    if (i > 1 && !(size < last_change)) {  // the first change closes a gap of the strain, too: no rate follows from it
      converged = converged || size < newton_rounding * first_change;
      break;
    }
    last_change = size;
  }
  // Residuals of the rule's two equations for the exact motion, if its acceleration is linear in time.
  const rod::StrainVector left_q = -h * h / 6.0 * (a_begin + 2.0 * a);
  const rod::StrainVector left_v = -0.5 * h * (a - a_begin);
  const rod::StrainVector error_v = matrix.solve(h * (motion.K * left_q) - motion.M * left_v);
  state = next;
  return {h * error_v - left_q, 0.0, error_v, converged};
}

void ImplicitEuler::propagate_deviation(const HeldBody&, const motion::Trajectory&, double, double h,
                                        const StrainState&, const StrainState&, StrainState& deviation) {
  deviation.q_dot = last_->implicit(h).solve(last_->M * deviation.q_dot - h * (last_->K * deviation.q));
  deviation.q += h * deviation.q_dot;
}

namespace {

/// Steps side by side from the same state at `t`, one or two. Returns the motion about that state.
template <int n, int columns>
LinearisedMotion rodas_steps(const HeldBody& body, const motion::Trajectory& handle, double t,
                             const Eigen::Matrix<double, 1, columns>& h, Eigen::Matrix<double, n, columns>& q,
                             Eigen::Matrix<double, n, columns>& v) {
  using Column = Eigen::Matrix<double, n, 1>;
  using Columns = Eigen::Matrix<double, n, columns>;
  const double dt = time_difference * h[0];
  const auto a = accelerations(body, body.state_at(handle, t + dt * math::Pack{0.0, 1.0, 2.0, 2.0}),
                               math::side_by_side<n, math::pack_size>(q), math::side_by_side<n, math::pack_size>(v));
  Column by_time;
  for (int i = 0; i < n; ++i) by_time[i] = (-3.0 * a(i, 0) + 4.0 * a(i, 1) - a(i, 2)) / (2.0 * dt);
  const LinearisedMotion motion(body, body.state_at(handle, t), body.state_at(handle, t + math::Pack{}),
                                {q.col(0), v.col(0)}, a.col(0));
  const math::ImplicitMatrix first = motion.implicit(math::Rodas::gamma * h[0]),
                             last = motion.implicit(math::Rodas::gamma * h[columns - 1]);
  const auto acceleration = [&](double c, const Columns& q_c, const Columns& v_c) {
    if (c == 0.0) return math::side_by_side<n, columns>(a);
    const double longer = h[0], shorter = h[columns - 1];
    return accelerations(body, body.state_at(handle, t + c * math::Pack{longer, shorter, shorter, shorter}), q_c, v_c);
  };
  const auto solve = [&](const Columns& b) {
    Columns x;
    for (int k = 0; k < columns; ++k) x.col(k) = (k == 0 ? first : last).solve(Column(b.col(k)));
    return x;
  };
  math::Rodas::steps(motion.M, motion.K, h, acceleration, math::side_by_side<n, columns>(by_time), solve, q, v);
  return motion;
}

}  // namespace

StepEstimate Rosenbrock::step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                              StrainState& state) {
  return math::by_size(body.size(), [&](auto size) -> StepEstimate {
    constexpr int n = decltype(size)::value;
    Eigen::Matrix<double, n, 2> q = math::side_by_side<n, 2>(state.q), v = math::side_by_side<n, 2>(state.q_dot);
    last_ = rodas_steps<n, 2>(body, handle, t, {h, 0.5 * h}, q, v);  // the whole, and the first half
    Eigen::Matrix<double, n, 1> q_end = q.col(1), v_end = v.col(1);
    if (q_end.allFinite() && v_end.allFinite()) {
      last_ = rodas_steps<n, 1>(body, handle, t + 0.5 * h, Eigen::Matrix<double, 1, 1>(0.5 * h), q_end, v_end);
    }
    state = {q_end, v_end};
    const rod::StrainVector q_whole = q.col(0), v_whole = v.col(0);
    return {(q_whole - state.q) / finer_by, 0.0, (v_whole - state.q_dot) / finer_by};
  });
}

/// By the linear motion about the middle of the step.
void Rosenbrock::propagate_deviation(const HeldBody& body, const motion::Trajectory&, double, double h,
                                     const StrainState&, const StrainState&, StrainState& deviation) {
  math::by_size(body.size(), [&](auto size) {
    using Column = Eigen::Matrix<double, decltype(size)::value, 1>;
    Column q = deviation.q, v = deviation.q_dot;
    for (int half = 0; half < 2; ++half) {
      math::Rodas::linear_steps(last_->M, last_->D, last_->K, 0.5 * h, Column(Column::Zero()), q, v);
    }
    deviation = {q, v};
  });
}

/// The deviations under generalised forces of 1, one per column.
Integrator::Response Rosenbrock::response(const HeldBody& body, const HandleState& handle, double h,
                                          const StrainState& state) {
  return math::by_size(body.size(), [&](auto size) -> Response {
    using Columns = Eigen::Matrix<double, decltype(size)::value, decltype(size)::value>;
    Columns q = Columns::Zero(), v = q;
    const LinearisedMotion motion(body, handle, state.q);
    math::Rodas::linear_steps(motion.M, motion.D, motion.K, h, Columns(Columns::Identity()), q, v);
    return {q, v};
  });
}

}  // namespace spring_workbench::dynamics
