#pragma once

#include <array>
#include <cstddef>

#include "spring_workbench/math/phi_functions.h"

namespace spring_workbench::math {

/// Exponential collocation at the four Lobatto nodes of a step: in ẋ = λ x + N(t), N is the cubic through its values at
/// the nodes, so that `x(c_i h) = e^{c_i h λ} x₀ + h Σ_j a_ij(hλ) N_j` (Hochbruck and Ostermann, Acta Numerica 2010,
/// section 2.1).
struct Collocation {
  static constexpr std::size_t count = 4;
  /// 0, ½ ∓ √5/10, 1.
  static constexpr std::array<double, count> nodes{0.0, 0.27639320225002103, 0.72360679774997897, 1.0};

  using Row = std::array<double, count>;
  /// `power[k][j]`: coefficient of cᵏ in the cubic that is 1 at node j and 0 at the others.
  static const std::array<Row, count>& power();
  /// Third divided difference of values at the nodes, and the mean of their two second ones.
  static const Row& third_difference();
  static const Row& second_difference();
  /// Weights that continue the cubic of the last step, `ratio` times as long as this one, to the nodes of this one.
  static std::array<Row, count> continued(double ratio);

  /// What one mode needs for a step, `Scalar` real or complex.
  template <typename Scalar>
  struct Weights {
    std::array<Scalar, count> decay;                    ///< e^{c_i z}
    std::array<std::array<Scalar, count>, count> node;  ///< a_ij; row 0 is zero
    Scalar error;  ///< ∫₀¹ e^{(1−c)z} Π_j (c − c_j) dc: what one unit of the fourth divided difference does to the end
  };
  /// For `z` = h λ.
  template <typename Scalar>
  static Weights<Scalar> weights(Scalar z);
};

template <typename Scalar>
Collocation::Weights<Scalar> Collocation::weights(Scalar z) {
  Weights<Scalar> w{};
  w.decay[0] = 1.0;
  for (std::size_t i = 1; i < count; ++i) {
    const double c = nodes[i];
    const std::array<Scalar, 6> phi = phi_functions(Scalar(c * z));
    w.decay[i] = phi[0];
    // ∫₀ᶜ e^{(c−s)z} sᵏ ds = k! c^{k+1} φ_{k+1}(c z)
    std::array<Scalar, count> integral;
    double factor = c;
    for (std::size_t k = 0; k < count; ++k) {
      integral[k] = factor * phi[k + 1];
      factor *= c * static_cast<double>(k + 1);
    }
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t k = 0; k < count; ++k) w.node[i][j] += integral[k] * power()[k][j];
    }
    // Π (c − c_j) = c⁴ − 2 c³ + 6/5 c² − c/5
    if (i == count - 1) w.error = 24.0 * phi[5] - 12.0 * phi[4] + 2.4 * phi[3] - 0.2 * phi[2];
  }
  return w;
}

}  // namespace spring_workbench::math
