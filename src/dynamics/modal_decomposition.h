#pragma once

#include <array>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/math/general_complex.h"

namespace spring_workbench::dynamics {

/// The linear part of the equation of motion about a strain at rest, `q̈ = −stiffness q − damping q̇ + …`, and its modes:
/// in `x = to_modes · (q, q̇)` it falls apart into single real modes, `ẋ = rate x`, and pairs (math::RealModes).
struct ModalDecomposition {
  static constexpr int most_modes = 2 * rod::max_strain_coordinates;
  using ModeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_modes, most_modes>;

  rod::StrainVector q_reference;
  rod::StrainMatrix stiffness, damping;  ///< M⁻¹ K with the loads' own stiffness, and M⁻¹ D
  rod::StrainMatrix inverse_mass;
  rod::StrainVector mass;  ///< diagonal of M
  /// To the modes without damping, in which M is the unit matrix; and what velocities there swing or run out to, which
  /// is at most the velocity over this rate [1/s], > 0.
  rod::StrainMatrix to_undamped;
  rod::StrainVector swing_rates;
  /// Acceleration of the coordinates by a wrench [force; moment] on the object at its centre of mass, axes of H; and by
  /// the handle's acceleration less gravity and its angular acceleration.
  Eigen::Matrix<double, Eigen::Dynamic, 6, 0, rod::max_strain_coordinates, 6> by_wrench, by_handle;
  ModeMatrix to_modes, from_modes;  ///< inverse of each other; not finite where the equation overflows and has no modes
  /// The first 2 `pairs` modes are pairs, of rates a + b j: ẋ₀ = a x₀ + b x₁, ẋ₁ = a x₁ + j² b x₀.
  int pairs = 0;
  std::array<math::GeneralComplex, most_modes> rates;  ///< [1/s]; a pair has its rate twice
  double fastest = 0.0;                                ///< largest |rate|

  void exchange(math::StateArchive& state) {
    state(q_reference, stiffness, damping, inverse_mass, mass, to_undamped, swing_rates, by_wrench, by_handle, to_modes,
          from_modes, pairs, rates, fastest);
  }
};

/// About `state.q`, under the handle's acceleration and the loads of the moment.
ModalDecomposition modal_decomposition(const HeldBody& body, const HandleForcing& handle, const rod::StrainVector& q);

}  // namespace spring_workbench::dynamics
