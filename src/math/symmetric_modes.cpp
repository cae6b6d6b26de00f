// The only source that instantiates Eigen's symmetric solvers for these sizes, which takes seconds to compile.
#include "spring_workbench/math/symmetric_modes.h"

#include <Eigen/Eigenvalues>

namespace spring_workbench::math {

SymmetricModes symmetric_modes(const SymmetricModes::Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<SymmetricModes::Matrix> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricModes symmetric_modes(const SymmetricModes::Matrix& K, const SymmetricModes::Matrix& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<SymmetricModes::Matrix> solver(K, M);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace spring_workbench::math
