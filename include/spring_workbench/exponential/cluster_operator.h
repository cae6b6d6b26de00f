#pragma once

#include <vector>

#include "spring_workbench/exponential/cluster_functions.h"

namespace spring_workbench::exponential {

/// Four functions of the clusters of ModalRates, one in each lane, as a matrix.
class ClusterOperator {
 public:
  /// Number of modes in clusters; 0 in most motions.
  int size() const { return size_; }
  void set_zero(int size);
  /// Sets the block that begins at element (`first`, `first`), times a factor.
  void set(int first, double factor, const ClusterFunctions& block);
  /// Sets the same block in one lane, to that in another lane of `block`.
  void set_lane(int lane, int first, double factor, const ClusterFunctions& block, int from);
  /// Adds the functions, each applied to its lane of `x`, to `y`.
  void add_applied(const math::Pack* x, math::Pack* y) const;

 private:
  int size_ = 0;
  std::vector<math::Pack> rows_;  ///< takes memory where there are clusters only
};

}  // namespace spring_workbench::exponential
