#pragma once

#include "spring_workbench/math/pack.h"

namespace spring_workbench::math {

/// Solves `M x = b` for a small symmetric positive definite `M` and overwrites `b` by `x`: L D Lᵀ without roots or
/// pivots. Reads and overwrites the lower triangle of `M`, stored by rows. One system or, with packs, several.
template <int n, typename S>
SPRING_WORKBENCH_INLINE void solve_positive_definite(S* M, S* b) {
  S inverse[n];
  for (int j = 0; j < n; ++j) {
    inverse[j] = 1.0 / M[j * n + j];
    for (int i = j + 1; i < n; ++i) {
      const S l = M[i * n + j] * inverse[j];
      for (int k = i; k < n; ++k) M[k * n + i] -= M[k * n + j] * l;
      b[i] -= l * b[j];
    }
  }
  for (int j = n - 1; j >= 0; --j) {
    for (int i = j + 1; i < n; ++i) b[j] -= M[i * n + j] * b[i];
    b[j] *= inverse[j];
  }
}

}  // namespace spring_workbench::math
