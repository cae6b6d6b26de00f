#pragma once

#include <array>

#include "spring_workbench/exponential/cluster_functions.h"

namespace spring_workbench::exponential {

/// Four functions of the clusters of ModalRates, one in each lane, as a matrix.
class ClusterOperator {
 public:
  /// Memory for a matrix. Not initialised: without clusters its pages are not used.
  using Rows = std::array<math::Pack, static_cast<std::size_t>(ModalRates::max_modes* ModalRates::max_modes)>;
  /// Keeps the matrix in `rows`, which must outlive this.
  void keep_in(Rows& rows) { rows_ = rows.data(); }
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
  math::Pack* rows_ = nullptr;
};

}  // namespace spring_workbench::exponential
