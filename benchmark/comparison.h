#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/curve.h"

namespace spring_workbench::benchmark {

/// Times the uncertainty of a reference: a smaller error says nothing, since a line ends there.
constexpr double least_of_reference = 2.0;

/// What an error is asked to be: a share of the hand's amplitude or of the largest deflection.
struct ErrorTarget {
  double error = 1e-6;
  ErrorMeasure measure = &ErrorRow::error_over_hand_amplitude;

  std::string text() const;  ///< e.g. "1e-06 of the amplitude"
};

/// Ours, `exponential`, beside one other method at an error that both have: the target, or the error with which the
/// other's line begins where that is smaller, or, where ours was not measured as far down, the least that ours has.
struct Pair {
  std::string peer;
  double error = 0.0;                     ///< compared at, in the target's measure
  std::optional<double> ours, peer_time;  ///< [µs per simulated second]; none where the error is not reached
  /// Where the peer does not reach it: it is slower than that, since its line was still coming down where it ends, by
  /// its budget of time or its finest setting [µs per simulated second]; infinite where it comes no further down.
  double peer_beyond = 0.0;

  /// The peer's run time over ours, or, where its line ended before, what that exceeds: infinite where only
  /// ours arrives, 0 where only the peer does, nothing where neither does.
  std::optional<double> ratio() const;
};

/// The rows of one scene, stiffness, mass and knowledge of the hand.
struct SceneRows {
  std::vector<ErrorRow> rows;

  /// The target as a share of the largest deflection.
  double share_of_deflection(const ErrorTarget& target) const;
  /// Of the reference, in the target's measure.
  double uncertainty(const ErrorTarget& target) const;
  /// Ours beside each of the methods that are not ours and `wanted`, those that compare worst for ours first; those
  /// where neither arrives are last. Without peers whose own limit, against which they are measured, is not known well
  /// enough for the target.
  std::vector<Pair> pairs(const ErrorTarget& target, const std::function<bool(const std::string&)>& wanted) const;
};

/// The rows of each scene as title_of() tells them apart, in their order.
std::vector<SceneRows> by_scene(const std::vector<ErrorRow>& rows);

}  // namespace spring_workbench::benchmark
