#pragma once

#include <array>

#include "spring_workbench/exponential/modal_rates.h"

namespace spring_workbench::exponential {

/// A real quasi-triangular matrix T, separated into invariant subspaces: T Y = Y B, where Y is unit upper triangular
/// and B is zero between columns with different numbers in `cluster`. Between subspaces the elements of Y solve
/// Sylvester equations. Where one would be large, the two subspaces become one instead, so that Y is well conditioned
/// (Bavely and Stewart, SIAM J. Numer. Anal. 16, 1979; Golub and Van Loan, Matrix Computations, 7.6.3).
struct TriangularSeparation {
  ModalRates::Matrix Y, B;
  std::array<int, ModalRates::max_modes> cluster{};

  explicit TriangularSeparation(const ModalRates::Matrix& T);
};

}  // namespace spring_workbench::exponential
