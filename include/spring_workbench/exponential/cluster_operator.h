#pragma once

#include <array>

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
  /// The first size_² are used. Not initialised: without clusters its pages take no memory.
  std::array<math::Pack, static_cast<std::size_t>(ModalRates::max_modes* ModalRates::max_modes)> rows_;
};

}  // namespace spring_workbench::exponential
