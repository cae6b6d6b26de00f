#include "implicit_integrators.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "accelerations.h"
#include "constants.h"
#include "spring_workbench/dynamics/linearised_motion.h"
#include "spring_workbench/math/by_size.h"

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

/// Steps side by side: a column of `q` and `v` for each, and its length in `h`. `acceleration(c, q, v)` at t + c h,
/// `by_time` its derivative by time; `solve(b)`: (M + γ h D + γ² h² K)⁻¹ b.
template <typename Matrix, typename Lengths, typename Acceleration, typename Solve>
void rodas_steps(const LinearisedMotion& motion, const Lengths& h, const Acceleration& acceleration,
                 const Matrix& by_time, const Solve& solve, Matrix& q, Matrix& v) {
  constexpr int n = Matrix::RowsAtCompileTime;
  const Eigen::Matrix<double, n, n> M = motion.M, K = motion.K;
  const Lengths d = gamma_t[0] * h, over_h = h.cwiseInverse();  // γ_i of the first stage is γ
  Matrix Q[stages], V[stages];
  for (std::size_t i = 0; i < stages; ++i) {
    Matrix q_i = q, v_i = v, rest_q = Matrix::Zero(), rest_v = Matrix::Zero();
    for (std::size_t j = 0; j < i; ++j) {
      q_i += a_ij[i][j] * Q[j];
      v_i += a_ij[i][j] * V[j];
      rest_q += c_ij[i][j] * Q[j];
      rest_v += c_ij[i][j] * V[j];
    }
    rest_q = rest_q * over_h.asDiagonal() + v_i;
    rest_v = rest_v * over_h.asDiagonal() + acceleration(alpha[i], q_i, v_i) + by_time * (gamma_t[i] * h).asDiagonal();
    V[i] = solve(Matrix((M * rest_v - K * rest_q * d.asDiagonal()) * d.asDiagonal()));
    Q[i] = (V[i] + rest_q) * d.asDiagonal();
    if (i + 1 == stages) {
      q = q_i + Q[i];
      v = v_i + V[i];
    }
  }
}

/// Steps side by side from the same state at `t`, one or two.
template <int n, int columns>
void rodas_steps(const HeldBody& body, const motion::FrameMotion& handle, double t,
                 const Eigen::Matrix<double, 1, columns>& h, Eigen::Matrix<double, n, columns>& q,
                 Eigen::Matrix<double, n, columns>& v) {
  using Columns = Eigen::Matrix<double, n, columns>;
  const double dt = time_difference * h[0];
  const Eigen::Matrix<double, n, 3> a =
      accelerations<n, 3>(body, body.forcing(handle, t + dt * math::Pack{0.0, 1.0, 2.0, 2.0}),
                          q.col(0).template replicate<1, 3>(), v.col(0).template replicate<1, 3>());
  const LinearisedMotion motion(body, body.forcing(handle, t), body.forcing(handle, t + math::Pack{}),
                                {q.col(0), v.col(0)}, a.col(0));
  const ImplicitMatrix first(motion, gamma_t[0] * h[0]), last(motion, gamma_t[0] * h[columns - 1]);
  const auto acceleration = [&](double c, const Columns& q_c, const Columns& v_c) -> Columns {
    if (c == 0.0) return a.col(0).template replicate<1, columns>();
    const double longer = h[0], shorter = h[columns - 1];
    return accelerations(body, body.forcing(handle, t + c * math::Pack{longer, shorter, shorter, shorter}), q_c, v_c);
  };
  const auto solve = [&](const Columns& b) {
    Columns x;
    for (int k = 0; k < columns; ++k) x.col(k) = (k == 0 ? first : last).solve(Eigen::Matrix<double, n, 1>(b.col(k)));
    return x;
  };
  const Columns by_time = ((-3.0 * a.col(0) + 4.0 * a.col(1) - a.col(2)) / (2.0 * dt)).template replicate<1, columns>();
  rodas_steps(motion, h, acceleration, by_time, solve, q, v);
}

}  // namespace

StepEstimate Rosenbrock::step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                              StrainState& state) {
  return math::by_size(body.size(), [&](auto size) -> StepEstimate {
    constexpr int n = decltype(size)::value;
    Eigen::Matrix<double, n, 2> q = state.q.replicate<1, 2>(), v = state.q_dot.replicate<1, 2>();
    rodas_steps<n, 2>(body, handle, t, {h, 0.5 * h}, q, v);  // the whole, and the first half
    Eigen::Matrix<double, n, 1> q_end = q.col(1), v_end = v.col(1);
    if (q_end.allFinite() && v_end.allFinite()) {
      rodas_steps<n, 1>(body, handle, t + 0.5 * h, Eigen::Matrix<double, 1, 1>(0.5 * h), q_end, v_end);
    }
    state = {q_end, v_end};
    return {(q.col(0) - q_end) / finer_by, 0.0, (v.col(0) - v_end) / finer_by};
  });
}

/// The deviations under generalised forces of 1, one per column.
Integrator::Response Rosenbrock::response(const HeldBody& body, const HandleForcing& handle, double h,
                                          const StrainState& state) {
  const LinearisedMotion motion(body, handle, state.q);
  const ImplicitMatrix matrix(motion, gamma_t[0] * h);
  const Eigen::LLT<rod::StrainMatrix> M(motion.M);
  return math::by_size(body.size(), [&](auto size) -> Response {
    using Columns = Eigen::Matrix<double, decltype(size)::value, decltype(size)::value>;
    const Columns K = motion.K, D = motion.D, none = Columns::Zero();
    Columns q = none, v = none;
    const auto acceleration = [&](double, const Columns& q_c, const Columns& v_c) {
      return Columns(M.solve(Columns::Identity() - K * q_c - D * v_c));
    };
    const auto solve = [&](const Columns& b) { return matrix.solve(b); };
    const Eigen::Matrix<double, 1, decltype(size)::value> lengths = Columns::Constant(h).row(0);
    rodas_steps(motion, lengths, acceleration, none, solve, q, v);
    return {q, v};
  });
}

}  // namespace spring_workbench::dynamics
