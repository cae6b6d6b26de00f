#include "spring_workbench/exponential/cluster_operator.h"

namespace spring_workbench::exponential {

void ClusterOperator::set_zero(int size) {
  size_ = size;
  std::fill_n(rows_, size * size, math::Pack{});
}

void ClusterOperator::set(int first, double factor, const ClusterFunctions& block) {
  for (int lane = 0; lane < math::pack_size; ++lane) set_lane(lane, first, factor, block, lane);
}

void ClusterOperator::set_lane(int lane, int first, double factor, const ClusterFunctions& block, int from) {
  for (int i = 0; i < block.size(); ++i) {
    for (int j = 0; j < block.size(); ++j) {
      const int element = (first + i) * size_ + first + j;
      rows_[element][lane] = factor * block(i, j)[from];
    }
  }
}

void ClusterOperator::add_applied(const math::Pack* x, math::Pack* y) const {
  const math::Pack* element = rows_;
  for (int i = 0; i < size_; ++i) {
    for (int j = 0; j < size_; ++j) y[i] += *element++ * x[j];
  }
}

}  // namespace spring_workbench::exponential
