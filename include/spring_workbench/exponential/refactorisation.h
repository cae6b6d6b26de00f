#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::exponential {

/// Decides when a step of `n` coordinates gets a new linear part. A linear part that is frozen at a distant strain
/// slows the iterations down, but computing a new one costs as much as many iterations.
template <int n>
class Refactorisation {
 public:
  using Strain = Eigen::Matrix<double, n, 1>;

  /// Call this when the linear part has been computed at the strain `q`.
  void restart(const Strain& q) {
    begin_ = q;
    path_ = 0.0;
    steps_ = slow_iterations_ = 0;
  }
  /// Counts a step that begins at the strain `q`. Returns whether to compute a new linear part: when the steps since
  /// the last one have used up the budget of slow iterations, or when the strain has moved away from that of the linear
  /// part by more than max_steps_back times the mean length of these steps. `mass` [kg] weighs the coordinates.
  bool is_due(const Strain& q, const Strain& q_reference, const Strain& mass) {
    const auto length = [&mass](const Strain& path) { return std::sqrt(mass.dot(path.cwiseAbs2())); };
    path_ += length(q - std::exchange(begin_, q));
    const double from_reference = length(q - q_reference);
    return from_reference * ++steps_ > max_steps_back * path_ || (slow_iterations_ > budget && from_reference > 0.0);
  }
  /// Counts the iterations of a step.
  void add(int iterations) { slow_iterations_ += std::max(0, iterations - fast_iterations); }

  void archive(math::StateArchive& state) { state(begin_, path_, steps_, slow_iterations_); }

  /// Distance from the strain of the linear part at which a new one is computed, in mean steps.
  static constexpr double max_steps_back = 50.0;
  /// Iterations of a step beyond this number count against the budget.
  static constexpr int fast_iterations = 3;
  /// Number of iterations that cost as much as computing a linear part.
  static constexpr int budget = 150;

 private:
  Strain begin_ = Strain::Zero();  ///< strain at the start of the last step
  double path_ = 0.0;              ///< length of the path of the strain with this linear part [m √kg]
  int steps_ = 0;                  ///< with this linear part
  int slow_iterations_ = 0;        ///< iterations beyond fast_iterations, with this linear part
};

}  // namespace spring_workbench::exponential
