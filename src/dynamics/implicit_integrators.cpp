#include "implicit_integrators.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "constants.h"
#include "spring_workbench/dynamics/linearised_motion.h"

namespace spring_workbench::dynamics {
StepEstimate ImplicitEuler::step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                                 StrainState& state) {
  const HandleForcing end = body.forcing(handle, t + h);
  const rod::StrainVector a_begin = body.acceleration(body.forcing(handle, t), state.q, state.q_dot);
  StrainState next = state;
  rod::StrainVector a = body.acceleration(end, next.q, next.q_dot);
  const LinearisedMotion motion(body, end, body.forcing(handle, t + h + math::Pack{}), next, a);
  const ImplicitMatrix matrix(motion, h);
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

namespace {

/// RODASP. Stage i: u + Σ a_ij U_j at t + α_i h, and h γ_i times the derivative by time.
constexpr double alpha[] = {0.0, 0.75, 0.21, 0.63, 1.0, 1.0};
constexpr std::size_t stages = std::size(alpha);
constexpr double gamma_t[stages] = {0.25, -0.5, -0.023504, -0.0362, 0.0, 0.0};
constexpr double a_ij[stages][stages] = {
    {},
    {3.0},
    {1.831036793486759, 0.4955183967433795},
    {2.304376582692669, -0.05249275245743001, -1.176798761832782},
    {-7.170454962423024, -4.741636671481785, -16.31002631330971, -1.062004044111401},
    {-7.170454962423024, -4.741636671481785, -16.31002631330971, -1.062004044111401, 1.0}};
constexpr double c_ij[stages][stages] = {
    {},
    {-12.0},
    {-8.791795173947035, -2.207865586973518},
    {10.81793056857153, 6.780270611428266, 19.53485944642410},
    {34.19095006749676, 15.49671153725963, 54.74760875964130, 14.16005392148534},
    {34.62605830930532, 15.30084976114473, 56.99955578662667, 18.40807009793095, -5.714285714285717}};

/// One step from (q, v), each column a state of its own; `acceleration(c, q, v)` at t + c h, `by_time` its derivative
/// by time.
template <typename Matrix, typename Acceleration>
void rodas_step(const LinearisedMotion& motion, double h, const Acceleration& acceleration, const Matrix& by_time,
                Matrix& q, Matrix& v) {
  const double d = gamma_t[0] * h;  // γ_i of the first stage is γ
  const ImplicitMatrix matrix(motion, d);
  Matrix Q[stages], V[stages];
  for (std::size_t i = 0; i < stages; ++i) {
    Matrix q_i = q, v_i = v;
    Matrix rest_q = Matrix::Zero(q.rows(), q.cols()), rest_v = rest_q;
    for (std::size_t j = 0; j < i; ++j) {
      q_i += a_ij[i][j] * Q[j];
      v_i += a_ij[i][j] * V[j];
      rest_q += (c_ij[i][j] / h) * Q[j];
      rest_v += (c_ij[i][j] / h) * V[j];
    }
    rest_q += v_i;
    rest_v += acceleration(alpha[i], q_i, v_i) + (gamma_t[i] * h) * by_time;
    V[i] = matrix.solve(d * (motion.M * rest_v) - d * d * (motion.K * rest_q));
    Q[i] = d * (V[i] + rest_q);
    if (i + 1 == stages) {
      q = q_i + Q[i];
      v = v_i + V[i];
    }
  }
}

/// Forcing, acceleration and linearised motion at the start of a step.
struct StepStart {
  HandleForcing forcing;
  rod::StrainVector q_ddot;
  LinearisedMotion motion;

  StepStart(const HeldBody& body, const motion::FrameMotion& handle, double t, const StrainState& state)
      : forcing(body.forcing(handle, t)),
        q_ddot(body.acceleration(forcing, state.q, state.q_dot)),
        motion(body, forcing, body.forcing(handle, t + math::Pack{}), state, q_ddot) {}
};

StrainState rodas_step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                       const StrainState& from, const StepStart& start) {
  const auto acceleration = [&](double c, const rod::StrainVector& q, const rod::StrainVector& v) {
    return c == 0.0 ? start.q_ddot : body.acceleration(body.forcing(handle, t + c * h), q, v);
  };
  const rod::StrainVector by_time = (-3.0 * start.q_ddot + 4.0 * acceleration(time_difference, from.q, from.q_dot) -
                                     acceleration(2.0 * time_difference, from.q, from.q_dot)) /
                                    (2.0 * time_difference * h);
  StrainState to = from;
  rodas_step(start.motion, h, acceleration, by_time, to.q, to.q_dot);
  return to;
}

}  // namespace

StepEstimate Rosenbrock::step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                              StrainState& state) {
  const StepStart begin(body, handle, t, state);
  const StrainState whole = rodas_step(body, handle, t, h, state, begin);
  const StrainState half = rodas_step(body, handle, t, 0.5 * h, state, begin);
  if (!half.q.allFinite() || !half.q_dot.allFinite()) {
    state = half;
    return {whole.q, 0.0, whole.q_dot};
  }
  const StepStart middle(body, handle, t + 0.5 * h, half);
  state = rodas_step(body, handle, t + 0.5 * h, 0.5 * h, half, middle);
  return {(whole.q - state.q) / finer_by, 0.0, (whole.q_dot - state.q_dot) / finer_by};
}

/// The deviations under generalised forces of 1, one per column.
Integrator::Response Rosenbrock::response(const HeldBody& body, const HandleForcing& handle, double h,
                                          const StrainState& state) {
  const int n = body.size();
  const LinearisedMotion motion(body, handle, state.q);
  const Eigen::LLT<rod::StrainMatrix> M(motion.M);
  const rod::StrainMatrix none = rod::StrainMatrix::Zero(n, n);
  Response r{none, none};
  const auto acceleration = [&](double, const rod::StrainMatrix& q, const rod::StrainMatrix& v) {
    return rod::StrainMatrix(M.solve(rod::StrainMatrix::Identity(n, n) - motion.K * q - motion.D * v));
  };
  rodas_step(motion, h, acceleration, none, r.q, r.q_dot);
  return r;
}

}  // namespace spring_workbench::dynamics
