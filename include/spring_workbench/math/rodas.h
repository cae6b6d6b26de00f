#pragma once

#include <Eigen/Cholesky>

#include "spring_workbench/math/implicit_matrix.h"

namespace spring_workbench::math {

/// RODASP, a Rosenbrock method of order four, stiffly accurate and L-stable (Steinebach 1995; Hairer and Wanner,
/// Solving Ordinary Differential Equations II, equation IV.7.25), for M ẍ = f(t, x, ẋ).
struct Rodas {
  static constexpr int stages = 6;
  /// Stage i: u + Σ a_ij U_j at t + α_i h, and h γ_i times the derivative by time. γ of the matrix is that of the
  /// first.
  static constexpr double gamma = 0.25;
  static constexpr double alpha[stages] = {0.0, 0.75, 0.21, 0.63, 1.0, 1.0};
  static constexpr double gamma_t[stages] = {gamma, -0.5, -0.023504, -0.0362, 0.0, 0.0};
  static constexpr double a_ij[stages][stages] = {
      {},
      {3.0},
      {1.831036793486759, 0.4955183967433795},
      {2.304376582692669, -0.05249275245743001, -1.176798761832782},
      {-7.170454962423024, -4.741636671481785, -16.31002631330971, -1.062004044111401},
      {-7.170454962423024, -4.741636671481785, -16.31002631330971, -1.062004044111401, 1.0}};
  static constexpr double c_ij[stages][stages] = {
      {},
      {-12.0},
      {-8.791795173947035, -2.207865586973518},
      {10.81793056857153, 6.780270611428266, 19.53485944642410},
      {34.19095006749676, 15.49671153725963, 54.74760875964130, 14.16005392148534},
      {34.62605830930532, 15.30084976114473, 56.99955578662667, 18.40807009793095, -5.714285714285717}};

  /// Steps side by side, of positions `x` and velocities `v`: a column for each, and its length in `h`.
  /// `acceleration(c, x, v)` at t + c h, `by_time` its derivative by time; `solve(b)`: (M + γ h D + γ² h² K)⁻¹ b, with
  /// f's derivatives −K and −D. Element by element, since Eigen's expressions of all sizes take long to compile.
  template <typename Square, typename Lengths, typename Acceleration, typename Matrix, typename Solve>
  static void steps(const Square& M, const Square& K, const Lengths& h, const Acceleration& acceleration,
                    const Matrix& by_time, const Solve& solve, Matrix& x, Matrix& v) {
    constexpr int n = Matrix::RowsAtCompileTime, size = Matrix::SizeAtCompileTime;
    const Eigen::Matrix<double, n, n> M_n = M, K_n = K;
    Matrix X[stages], V[stages], x_i, v_i, rest_x, rest_v;
    for (int i = 0; i < stages; ++i) {
      x_i = x;
      v_i = v;
      for (int e = 0; e < size; ++e) {
        double sum_x = 0.0, sum_v = 0.0;
        for (int j = 0; j < i; ++j) {
          x_i(e) += a_ij[i][j] * X[j](e);
          v_i(e) += a_ij[i][j] * V[j](e);
          sum_x += c_ij[i][j] * X[j](e);
          sum_v += c_ij[i][j] * V[j](e);
        }
        rest_x(e) = sum_x * (1.0 / h[e / n]) + v_i(e);
        rest_v(e) = sum_v * (1.0 / h[e / n]);
      }
      const Matrix a = acceleration(alpha[i], x_i, v_i);
      for (int e = 0; e < size; ++e) rest_v(e) = rest_v(e) + a(e) + by_time(e) * (gamma_t[i] * h[e / n]);
      const Matrix M_v = M_n * rest_v, K_x = K_n * rest_x;
      for (int e = 0; e < size; ++e) rest_v(e) = (M_v(e) - K_x(e) * (gamma * h[e / n])) * (gamma * h[e / n]);
      V[i] = solve(rest_v);
      for (int e = 0; e < size; ++e) X[i](e) = (V[i](e) + rest_x(e)) * (gamma * h[e / n]);
    }
    for (int e = 0; e < size; ++e) {
      x(e) = x_i(e) + X[stages - 1](e);
      v(e) = v_i(e) + V[stages - 1](e);
    }
  }

  /// Steps of the linear motion M ẍ = force − K x − D ẋ, side by side, all of `h` [s].
  template <typename Square, typename Matrix>
  static void linear_steps(const Square& M, const Square& D, const Square& K, double h, const Matrix& force, Matrix& x,
                           Matrix& v) {
    const ImplicitMatrix implicit(M, D, K, gamma * h);
    const Eigen::LLT<Square> factor(M);
    const Eigen::Matrix<double, Matrix::RowsAtCompileTime, Matrix::RowsAtCompileTime> K_n = K, D_n = D;
    const auto acceleration = [&](double, const Matrix& x_c, const Matrix& v_c) {
      return Matrix(factor.solve(force - K_n * x_c - D_n * v_c));
    };
    const auto solve = [&](const Matrix& b) { return Matrix(implicit.solve(ImplicitMatrix::Matrix(b))); };
    const auto lengths = Eigen::Matrix<double, 1, Matrix::ColsAtCompileTime>::Constant(h).eval();
    steps(M, K, lengths, acceleration, Matrix(Matrix::Zero()), solve, x, v);
  }
};

}  // namespace spring_workbench::math
