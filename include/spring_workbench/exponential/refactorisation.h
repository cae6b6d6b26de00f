#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::exponential {

/// Decides when a step of `n` coordinates gets a new linear part. One that is frozen at a strain far from the present
/// one makes iterations slow, and computing it costs as much as many iterations.
template <int n>
class Refactorisation {
 public:
  using Strain = Eigen::Matrix<double, n, 1>;

  /// The linear part has been computed at the strain `q`.
  void restart(const Strain& q) {
    begin_ = q;
    path_ = 0.0;
    steps_ = slow_iterations_ = 0;
  }
  /// Counts a step from the strain `q`. Returns whether a new linear part pays: the steps since the last one have spent
  /// the budget of slow iterations, or the strain is so far from that of the linear part that max_steps_back steps of
  /// the mean length since then would not lead back. `mass` [kg] weighs the coordinates.
  bool is_due(const Strain& q, const Strain& q_reference, const Strain& mass) {
    const auto length = [&mass](const Strain& path) { return std::sqrt(mass.dot(path.cwiseAbs2())); };
    path_ += length(q - std::exchange(begin_, q));
    const double from_reference = length(q - q_reference);
    return from_reference * ++steps_ > max_steps_back * path_ || (slow_iterations_ > budget && from_reference > 0.0);
  }
  /// Counts the iterations of a step.
  void add(int iterations) { slow_iterations_ += std::max(0, iterations - fast_iterations); }

  void exchange(math::StateArchive& state) { state(begin_, path_, steps_, slow_iterations_); }

  /// Steps from the present strain back to that of the linear part, for whose sake a new one pays.
  static constexpr double max_steps_back = 50.0;
  /// A step with no more iterations is at its best.
  static constexpr int fast_iterations = 3;
  /// Iterations that cost as much as a linear part does.
  static constexpr int budget = 150;

 private:
  Strain begin_ = Strain::Zero();  ///< of the last step
  double path_ = 0.0;              ///< length of the path of the strain with this linear part [m √kg]
  int steps_ = 0;                  ///< with this linear part
  int slow_iterations_ = 0;        ///< beyond fast_iterations, with this linear part
};

}  // namespace spring_workbench::exponential
