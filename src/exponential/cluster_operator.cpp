#include "spring_workbench/exponential/cluster_operator.h"

namespace spring_workbench::exponential {

void ClusterOperator::set_zero(int size) {
  size_ = size;
  std::fill_n(rows_.begin(), size * size, math::Pack{});
}

void ClusterOperator::set(std::size_t lane, int first, const ModalRates::Matrix& block) {
  for (int i = 0; i < block.rows(); ++i) {
    for (int j = 0; j < block.cols(); ++j) {
      const int element = (first + i) * size_ + first + j;
      rows_[static_cast<std::size_t>(element)][lane] = block(i, j);
    }
  }
}

void ClusterOperator::add_applied(const math::Pack* x, math::Pack* y) const {
  const math::Pack* element = rows_.data();
  for (int i = 0; i < size_; ++i) {
    for (int j = 0; j < size_; ++j) y[i] += *element++ * x[j];
  }
}

}  // namespace spring_workbench::exponential
