#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/curve.h"

namespace spring_workbench::benchmark {

/// Multiple of the reference's uncertainty below which an error is not significant; curves end there.
constexpr double min_of_reference = 2.0;

/// A target for errors: a fraction of the hand's amplitude or of the largest deflection.
struct ErrorTarget {
  double error = 1e-6;
  ErrorMeasure measure = &ErrorRow::error_over_hand_amplitude;

  std::string text() const;  ///< e.g. "1e-06 of the amplitude"
};

/// Our integrator `exponential` compared with one other method at an error that both reach: the target; or the first
/// error of the other's curve, if that is smaller; or our smallest error, if ours was not measured down to the target;
/// but none below what the reference resolves.
struct Pair {
  std::string baseline;
  double error = 0.0;                         ///< error at which they are compared, in the target's measure
  std::optional<double> ours, baseline_time;  ///< [µs per simulated second]; none if the error is not reached
  /// Lower bound of the baseline's run time if it does not reach the error, but its curve has not levelled off where it
  /// ended (time limit or finest setting) [µs per simulated second]; infinite if it has, or if the baseline failed
  /// there.
  double baseline_beyond = 0.0;

  /// Ratio of the baseline's run time to ours, or a lower bound if its curve ended before. Infinite if only ours
  /// reaches the error, 0 if only the baseline does, nothing if neither does.
  std::optional<double> ratio() const;
};

/// The rows of one scene, stiffness, mass and knowledge of the hand.
struct SceneRows {
  std::vector<ErrorRow> rows;
  bool interpolates = true;  ///< whether run times between two settings are used; else those of measured ones alone

  /// Run time of a method for an error [µs per simulated second]; nothing if it does not reach it.
  std::optional<double> run_time(const std::vector<CurvePoint>& line, double error) const {
    return interpolates ? run_time_for_error(line, error) : least_run_time_within(line, error);
  }
  /// The target as a fraction of the largest deflection.
  double share_of_deflection(const ErrorTarget& target) const;
  /// The target as a length [m], in B as an angle [rad]; infinite if the deflection is not known.
  double length_of(const ErrorTarget& target) const;
  /// What the samples of the hand leave open, as a fraction of the largest deflection; 0 if the hand is a function, or
  /// if it is not known.
  double left_by_samples() const;
  /// Uncertainty of the reference, in the target's measure.
  double uncertainty(const ErrorTarget& target) const;
  /// Compares ours with each `wanted` method of others. The worst results for ours come first, the faster of
  /// equal ones before the slower, and those that neither reaches last. Skips those of not_compared().
  std::vector<Pair> pairs(const ErrorTarget& target, const std::function<bool(const std::string&)>& wanted) const;
  /// Ratio of the least run time that any `wanted` method of others needs for an error of at most the target, to the
  /// least of ours; at each method's own error. Nothing unless both reach it.
  std::optional<double> ratio_within(const ErrorTarget& target,
                                     const std::function<bool(const std::string&)>& wanted) const;
  /// The `wanted` methods of others that are measured against their own limit, which is not known well enough for the
  /// target.
  std::vector<std::string> not_compared(const ErrorTarget& target,
                                        const std::function<bool(const std::string&)>& wanted) const;
  /// Whether a `wanted` method of others has a run that arrived.
  bool anyone_arrives(const std::function<bool(const std::string&)>& wanted) const;
};

/// The rows grouped by title_of(), in their order.
std::vector<SceneRows> by_scene(const std::vector<ErrorRow>& rows);

}  // namespace spring_workbench::benchmark
