#pragma once

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/exponential/modal_rates.h"

namespace spring_workbench::dynamics {

/// The linear part of the equation of motion at rest about a strain, `q̈ = −stiffness q − damping q̇ + …`, and its modes:
/// in `x = to_modes · (q, q̇)` it is block-diagonal (exponential::RealModes).
struct ModalDecomposition {
  using ModeMatrix = exponential::ModalRates::Matrix;
  static_assert(exponential::ModalRates::max_modes == 2 * rod::max_strain_coordinates);

  rod::StrainVector q_reference;
  rod::StrainMatrix stiffness, damping;  ///< M⁻¹ K, geometric stiffness of the loads included, and M⁻¹ D
  rod::StrainMatrix inverse_mass;
  rod::StrainVector mass;         ///< diagonal of M
  rod::StrainMatrix to_undamped;  ///< to the undamped modes, in which M is the unit matrix
  /// A velocity v of an undamped mode leads to an amplitude of v / rate at most [1/s], > 0.
  rod::StrainVector amplitude_rates;
  /// Acceleration of the coordinates by a wrench [force; moment] on the object at its centre of mass, axes of H; and by
  /// the handle's acceleration less gravity and its angular acceleration.
  Eigen::Matrix<double, Eigen::Dynamic, 6, 0, rod::max_strain_coordinates, 6> by_wrench, by_handle;
  ModeMatrix to_modes, from_modes;  ///< inverses of each other; not finite if the equation overflows and has no modes
  exponential::ModalRates rates;    ///< [1/s]
  double fastest = 0.0;             ///< largest |rate|

  void archive(math::StateArchive& state) {
    state(q_reference, stiffness, damping, inverse_mass, mass, to_undamped, amplitude_rates, by_wrench, by_handle,
          to_modes, from_modes, rates, fastest);
  }
};

/// Computes it about the strain `q`, under the handle's present acceleration and the present loads.
ModalDecomposition modal_decomposition(const HeldBody& body, const HandleState& handle, const rod::StrainVector& q);

}  // namespace spring_workbench::dynamics
