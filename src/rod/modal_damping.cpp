#include "spring_workbench/rod/modal_damping.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <cmath>

#include "spring_workbench/math/spatial.h"

namespace spring_workbench::rod {

// For the coordinates with stiffness: 2 ζ K^½ (K^½ M⁻¹ K^½)^-½ K^½, from the singular values of L⁻¹ K^½ with M = L Lᵀ,
// so that soft coordinates keep their digits next to stiff ones.
StrainMatrix modal_damping(const StrainMatrix& M, const StrainVector& K, double ratio) {
  const Eigen::Index n = K.size();
  StrainMatrix root = StrainMatrix::Zero(n, n);  // its first `stiff` columns
  Eigen::Index stiff = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (K[i] > 0.0) root(i, stiff++) = std::sqrt(K[i]);
  }
  if (stiff == 0) return root;
  root.conservativeResize(n, stiff);
  // Filled up with zeros to 6 × 6, because Eigen compiles a decomposition of a fixed square much faster: the largest
  // singular values, which come first, are those of the block, and so are their vectors.
  Matrix6d of_modes = Matrix6d::Zero();
  of_modes.topLeftCorner(n, stiff) = M.llt().matrixL().solve(root);
  const Eigen::JacobiSVD<Matrix6d> modes(of_modes, Eigen::ComputeFullV);
  const StrainMatrix V = modes.matrixV().topLeftCorner(stiff, stiff);
  const StrainVector frequencies = modes.singularValues().head(stiff);
  return 2.0 * ratio * root * V * frequencies.cwiseInverse().asDiagonal() * V.transpose() * root.transpose();
}

}  // namespace spring_workbench::rod
