#pragma once

#include <Eigen/Core>

namespace spring_workbench::test_support {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// The exponential of a small matrix in long double, by scaling and squaring.
inline LongMatrix exponential(LongMatrix A) {
  int halvings = 0;
  for (; A.norm() > 0.5L; ++halvings) A *= 0.5L;
  LongMatrix power = LongMatrix::Identity(A.rows(), A.cols()), sum = power;
  for (int k = 1; k < 25; ++k) {
    power = LongMatrix(power * A) / static_cast<long double>(k);
    sum += power;
  }
  for (; halvings > 0; --halvings) sum = LongMatrix(sum * sum);
  return sum;
}

}  // namespace spring_workbench::test_support
