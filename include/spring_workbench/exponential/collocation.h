#pragma once

#include <array>
#include <cstddef>

#include "spring_workbench/exponential/phi_functions.h"
#include "spring_workbench/math/pack.h"

namespace spring_workbench::exponential {

/// Exponential collocation at the four Radau nodes of a step: in ẋ = λ x + N(t), N is replaced by the cubic through its
/// values at the nodes, the collocation polynomial, so that `x(c h) = e^{c h λ} x₀ + h Σ_j a_j(c, hλ) N_j` (Hochbruck
/// and Ostermann, Acta Numerica 2010, section 2.1; the nodes: Hairer and Wanner, Solving Ordinary Differential
/// Equations II, IV.5). Of order seven if the step resolves λ. The defect, N minus that polynomial, is sampled at four
/// more moments.
struct Collocation {
  static constexpr std::size_t count = 4;
  /// The zeros of c⁴ − 16/7 c³ + 12/7 c² − 16/35 c + 1/35.
  static constexpr std::array<double, count> nodes{0.08858795951270395, 0.40946686444073471, 0.78765946176084706, 1.0};
  /// Weights of the nodes in an integral over the step, exact for polynomials of degree six (Radau's quadrature).
  static constexpr std::array<double, count> quadrature{0.22046221117676838, 0.38819346884317188, 0.32884431998005974,
                                                        0.0625};
  /// Moments at which the defect is sampled: the start, and the extremes of that polynomial between the nodes.
  static constexpr std::array<double, count> samples{0.0, 0.21234054, 0.59053314, 0.91141204};

  using Row = std::array<double, count>;
  /// `power()[k][j]`: coefficient of cᵏ in the cubic that is 1 at node j and 0 at the others.
  static const std::array<Row, count>& power();
  /// Weights of the values at the nodes in the collocation polynomial at `c`: it is Σ_j row[j] N_j.
  static Row interpolated(double c);
  /// Lane k of pack j: weight of node j in the collocation polynomial at sample k.
  static const std::array<math::Pack, count>& at_samples();
  /// `defect_power()[k]`: coefficients of the polynomial of degree seven that vanishes at the nodes, is 1 at sample k
  /// and 0 at the others.
  static const std::array<std::array<double, 2 * count>, count>& defect_power();

  /// A defect d, divided by the polynomial that vanishes at the nodes, is a cubic through the samples, whose
  /// coefficient of the third degree is Σ_k d_k / third_degree()[k].
  static const Row& third_degree();

  /// Coefficients of one mode or pair for a step: `Scalar` is real or GeneralComplex.
  template <typename Scalar>
  struct Weights {
    using Column = std::array<Scalar, count>;
    Column constant;                   ///< c_i φ₁(c_i z), the sum of row i of `node`
    std::array<Column, count> node;    ///< a_j(c_i, z)
    Column sample_constant;            ///< the same at the samples
    std::array<Column, count> sample;  ///< the same at the samples
    std::array<Column, count> defect;  ///< effect of a defect at each sample on each node, by the polynomials above
  };
  /// Returns the coefficients for `z` = h λ.
  template <typename Scalar>
  static Weights<Scalar> weights(Scalar z);
};

template <typename Scalar>
Collocation::Weights<Scalar> Collocation::weights(Scalar z) {
  Weights<Scalar> w{};
  const auto row = [](double c, const auto& phi, Scalar& constant, std::array<Scalar, count>& values) {
    // ∫₀ᶜ e^{(c−s)z} sᵏ ds = k! c^{k+1} φ_{k+1}(c z)
    std::array<Scalar, count> integral{};
    double factor = c;
    for (std::size_t k = 0; k < count; ++k) {
      integral[k] = factor * phi[k + 1];
      factor *= c * static_cast<double>(k + 1);
    }
    constant = integral[0];
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t k = 0; k < count; ++k) values[j] += integral[k] * power()[k][j];
    }
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto phi = phi_functions<2 * count>(Scalar(nodes[i] * z));
    row(nodes[i], phi, w.constant[i], w.node[i]);
    double factor = nodes[i];
    for (std::size_t m = 0; m < 2 * count; ++m) {
      for (std::size_t k = 0; k < count; ++k) w.defect[i][k] += (factor * defect_power()[k][m]) * phi[m + 1];
      factor *= nodes[i] * static_cast<double>(m + 1);
    }
  }
  for (std::size_t k = 1; k < count; ++k) {
    row(samples[k], phi_functions<count>(Scalar(samples[k] * z)), w.sample_constant[k], w.sample[k]);
  }
  return w;
}

}  // namespace spring_workbench::exponential
