#include "benchmark/comparison.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <sstream>
#include <tuple>

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kOurs = "exponential";

/// Computes Pair::baseline_beyond, for errors that the curve of `method` does not reach.
double end_of_line(const std::vector<ErrorRow>& rows, const std::string& method) {
  std::vector<ErrorRow> line;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(line),
               [&](const ErrorRow& row) { return row.method == method; });
  if (!line.empty() && line.back().given_up) return line.back().wall_us_per_simulated_second;
  const bool is_known = line.empty() || !line.back().finite || has_levelled_off(line);
  return is_known ? std::numeric_limits<double>::infinity() : line.back().wall_us_per_simulated_second;
}

/// Whether errors of this size are significant for `method`: for one that is measured against its own limit, down to
/// twice the uncertainty of that limit, if it was found.
bool is_resolved(const std::vector<ErrorRow>& rows, const std::string& method, const ErrorTarget& target) {
  for (const ErrorRow& row : rows) {
    if (row.method != method) continue;
    if (!row.own_reference) return true;
    if (row.finite && row.error > 0.0 && row.largest_deflection > 0.0) {
      return target.error >= min_of_reference * row.reference_uncertainty * row.*target.measure / row.error;
    }
  }
  return false;
}

}  // namespace

std::string ErrorTarget::text() const {
  std::ostringstream out;
  out << error
      << (measure == &ErrorRow::error_over_hand_amplitude ? " of the amplitude" : " of the largest deflection");
  return out.str();
}

std::optional<double> Pair::ratio() const {
  if (ours && baseline_time) return *baseline_time / *ours;
  if (ours) return baseline_beyond / *ours;
  if (baseline_time) return 0.0;
  return std::nullopt;
}

double SceneRows::share_of_deflection(const ErrorTarget& target) const {
  if (target.measure == &ErrorRow::error_over_largest_deflection) return target.error;
  for (const ErrorRow& row : rows) {
    if (row.finite && row.error > 0.0 && !row.own_reference) {
      return target.error * row.error_over_largest_deflection / row.error_over_hand_amplitude;
    }
  }
  return 0.0;
}

double SceneRows::length_of(const ErrorTarget& target) const {
  for (const ErrorRow& row : rows) {
    if (row.largest_deflection > 0.0 && !row.own_reference) return share_of_deflection(target) * row.largest_deflection;
  }
  return std::numeric_limits<double>::infinity();
}

double SceneRows::left_by_samples() const {
  for (const ErrorRow& row : rows) {
    if (row.hand == "samples" && row.hand_error > 0.0 && row.largest_deflection > 0.0)
      return row.hand_error / row.largest_deflection;
  }
  return 0.0;
}

double SceneRows::uncertainty(const ErrorTarget& target) const {
  for (const ErrorRow& row : rows) {
    if (row.finite && row.error > 0.0 && !row.own_reference)
      return row.reference_uncertainty * row.*target.measure / row.error;
  }
  return 0.0;
}

std::vector<Pair> SceneRows::pairs(const ErrorTarget& target,
                                   const std::function<bool(const std::string&)>& wanted) const {
  const auto line_of = [&](const std::string& method) {
    return curve(
        rows, [&](const ErrorRow& row) { return row.method == method; }, target.measure);
  };
  const std::vector<CurvePoint> ours = line_of(kOurs);
  std::vector<Pair> pairs;
  for (const ErrorRow& row : rows) {
    const auto same = [&](const Pair& pair) { return pair.baseline == row.method; };
    if (row.ours || !wanted(row.method) || std::any_of(pairs.begin(), pairs.end(), same)) continue;
    if (!is_resolved(rows, row.method, target)) continue;
    const std::vector<CurvePoint> line = line_of(row.method);
    const double least = min_of_reference * uncertainty(target);  // errors below it mean nothing
    const double error = std::min(target.error, std::max({first_error(line), min_error(ours), least}));
    pairs.push_back({row.method, error, run_time(ours, error), run_time(line, error), end_of_line(rows, row.method)});
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    const auto rank = [](const Pair& p) {
      constexpr double none = std::numeric_limits<double>::infinity();
      return std::tuple(!p.ratio(), p.ratio().value_or(none), p.baseline_time.value_or(none));
    };
    return rank(a) < rank(b);
  });
  return pairs;
}

std::optional<double> SceneRows::ratio_within(const ErrorTarget& target,
                                              const std::function<bool(const std::string&)>& wanted) const {
  const auto least_time = [&](const std::string& method) {
    const auto line = curve(
        rows, [&](const ErrorRow& row) { return row.method == method; }, target.measure);
    return run_time(line, target.error);
  };
  const std::optional<double> ours = least_time(kOurs);
  std::optional<double> others;
  for (const ErrorRow& row : rows) {
    if (row.ours || !wanted(row.method) || !is_resolved(rows, row.method, target)) continue;
    const std::optional<double> time = least_time(row.method);
    if (time) others = std::min(others.value_or(*time), *time);
  }
  if (!ours || !others) return std::nullopt;
  return *others / *ours;
}

std::vector<std::string> SceneRows::not_compared(const ErrorTarget& target,
                                                 const std::function<bool(const std::string&)>& wanted) const {
  std::vector<std::string> names;
  for (const ErrorRow& row : rows) {
    if (row.ours || !wanted(row.method) || is_resolved(rows, row.method, target)) continue;
    if (std::find(names.begin(), names.end(), row.method) == names.end()) names.push_back(row.method);
  }
  return names;
}

bool SceneRows::anyone_arrives(const std::function<bool(const std::string&)>& wanted) const {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const ErrorRow& row) { return !row.ours && row.finite && wanted(row.method); });
}

std::vector<SceneRows> by_scene(const std::vector<ErrorRow>& rows) {
  std::vector<SceneRows> scenes;
  for (const ErrorRow& row : rows) {
    auto found = std::find_if(scenes.begin(), scenes.end(),
                              [&](const SceneRows& scene) { return title_of(scene.rows[0]) == title_of(row); });
    if (found == scenes.end()) found = scenes.insert(scenes.end(), SceneRows{});
    found->rows.push_back(row);
  }
  return scenes;
}

}  // namespace spring_workbench::benchmark
