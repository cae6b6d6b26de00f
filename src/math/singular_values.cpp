// Here Eigen's decomposition of this size is instantiated, which takes seconds to compile.
#include "spring_workbench/math/singular_values.h"

#include <Eigen/SVD>

namespace spring_workbench::math {

SingularValues singular_values(const Matrix6d& A) {
  const Eigen::JacobiSVD<Matrix6d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.matrixV(), svd.singularValues()};
}

Vector6d least_squares(const Matrix6d& A, const Vector6d& b) {
  return Eigen::JacobiSVD<Matrix6d>(A, Eigen::ComputeFullU | Eigen::ComputeFullV).solve(b);
}

}  // namespace spring_workbench::math
