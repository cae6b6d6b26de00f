#pragma once

#include <Eigen/Core>
#include <cmath>

#include "spring_workbench/exponential/general_complex.h"

namespace spring_workbench::exponential {

/// The modes of a real 2 × 2 matrix A, such as that of an oscillator, in closed form: A vectors = vectors B, B as in
/// RealModes. The vectors are well conditioned whatever the rates, coincident ones included (critical damping).
struct OscillatorModes {
  /// Two real rates whose `square` is larger become two single modes, since their eigenvectors are far from parallel.
  static constexpr double max_square = 0.04;

  Eigen::Matrix2d vectors;  ///< orthonormal for a pair, so also if there is only one eigenvector
  bool pair = true;         ///< or two single real rates
  GeneralComplex rates[2];

  explicit OscillatorModes(const Eigen::Matrix2d& A) {
    const double mean = 0.5 * (A(0, 0) + A(1, 1)), half = 0.5 * (A(0, 0) - A(1, 1));
    const double symmetric = 0.5 * (A(0, 1) + A(1, 0)), odd = 0.5 * (A(0, 1) - A(1, 0));
    // After a rotation by the angle the diagonal is constant, and the rest of the symmetric part ((0, swing), (swing,
    // 0)).
    const double sign = odd < 0.0 ? -1.0 : 1.0, swing = sign * std::hypot(half, symmetric);
    const double angle = 0.5 * std::atan2(-sign * half, sign * symmetric);
    vectors << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const double upper = swing + odd, square = upper == 0.0 ? 0.0 : (swing - odd) / upper;
    rates[0] = rates[1] = GeneralComplex(mean, upper, square);
    pair = !(square > max_square);
    if (pair) return;
    const double fast = mean + std::copysign(upper * std::sqrt(square), mean);
    rates[0] = fast;
    rates[1] = (A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0)) / fast;
    Eigen::Matrix2d apart;
    apart << 1.0, 1.0, (fast - mean) / upper, (mean - fast) / upper;
    vectors *= apart;
  }
};

}  // namespace spring_workbench::exponential
