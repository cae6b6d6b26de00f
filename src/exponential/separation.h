#pragma once

#include <array>

#include "spring_workbench/exponential/modal_rates.h"

namespace spring_workbench::exponential {

/// A real matrix A, separated into invariant subspaces with well-conditioned columns, whatever the rates: A columns =
/// columns blocks. The columns of one subspace have the same number in `cluster`; between different subspaces `blocks`
/// is zero. Rows that nothing couples are separate from the start; the others have a real Schur form A = U T Uᵀ, which
/// is separated (TriangularSeparation).
struct Separation {
  using Matrix = ModalRates::Matrix;

  Matrix columns, inverse, blocks;  ///< not finite if A is not
  std::array<int, ModalRates::max_modes> cluster{};
};

Separation separated(const Separation::Matrix& A);

}  // namespace spring_workbench::exponential
