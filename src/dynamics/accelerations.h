#pragma once

#include <algorithm>

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::dynamics {

/// q̈ at up to four moments side by side: at each its state, in a column of `q` and `q_dot`.
template <int n, int columns>
Eigen::Matrix<double, n, columns> accelerations(const HeldBody& body, const HandleStates& handle,
                                                const Eigen::Matrix<double, n, columns>& q,
                                                const Eigen::Matrix<double, n, columns>& q_dot) {
  static_assert(columns <= math::pack_size);
  math::Pack q_lanes[n], q_dot_lanes[n], q_ddot[n];
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < math::pack_size; ++k) {
      q_lanes[i][k] = q(i, std::min(k, columns - 1));
      q_dot_lanes[i][k] = q_dot(i, std::min(k, columns - 1));
    }
  }
  body.acceleration<n>(handle, q_lanes, q_dot_lanes, q_ddot);
  Eigen::Matrix<double, n, columns> result;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < columns; ++k) result(i, k) = q_ddot[i][k];
  }
  return result;
}

}  // namespace spring_workbench::dynamics
