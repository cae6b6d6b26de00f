#pragma once

#include "spring_workbench/exponential/modal_rates.h"

namespace spring_workbench::exponential {

/// A real matrix A of up to ModalRates::max_modes rows in well-conditioned real columns that make it block-diagonal:
/// A vectors = vectors B, with B in `rates`. They span invariant subspaces of A, each as small as it can be without its
/// columns becoming nearly parallel to those of the others:
/// - pairs: two conjugate rates, or two real ones that may coincide (OscillatorModes);
/// - single real rates;
/// - clusters of three or more rates that are so close to each other that their eigenvectors are nearly parallel.
struct RealModes {
  using Matrix = ModalRates::Matrix;

  Matrix vectors, inverse;  ///< inverses of each other; not finite if A is not
  ModalRates rates;

  explicit RealModes(const Matrix& A);

  Matrix blocks() const;  ///< B
};

}  // namespace spring_workbench::exponential
