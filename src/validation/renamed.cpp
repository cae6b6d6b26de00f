#include "spring_workbench/validation/renamed.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::validation {
namespace {

/// Number of letters to insert, remove or replace to make `b` of `a` (Levenshtein's distance).
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);  // from the first letters of `a` to the first j of `b`
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({replaced, row[j] + 1, row[j + 1] + 1}));
    }
  }
  return row.back();
}

}  // namespace

const std::map<std::string, std::string>& renamed() {
  static const std::map<std::string, std::string> names = {
      {"fork.breakaway_force", "limit.force"},
      {"fork.breakaway_moment", "limit.moment"},
      {"truth.quaternion_tolerance", "input.quaternion_tolerance"},
      {"truth.max_distance", "input.max_distance"},
      {"truth.max_speed", "input.max_speed"},
      {"truth.max_turn_rate", "input.max_turn_rate"},
      {"truth.accept_after", "input.accept_after"},
      {"truth.origin_radius", "input.origin_radius"},
      {"truth.origin_angle", "input.origin_angle"},
      {"truth.filter.min_cutoff", "input.smoothing.min_cutoff"},
      {"truth.filter.beta", "input.smoothing.beta"},
      {"truth.filter.beta_angle", "input.smoothing.beta_angle"},
      {"truth.lost", "input.on_loss"},
      {"truth.lost_after", "input.loss_timeout"},
      {"truth.reengage_speed", "input.reacquisition_speed"},
      {"truth.reengage_turn_rate", "input.reacquisition_turn_rate"},
      {"guards_tripped", "steps_rejected"},
      {"held_back", "steps_blocked"},
      {"parts_run", "active"},
      {"parts_left_out", "skipped"},
      {"handle_seen", "proxy_handle"},
      {"bisection_levels", "impact_bisections"},
      {"steps_unbounded", "integrations_without_bound"},
  };
  return names;
}

const std::map<std::string, std::string>& renamed_values() {
  static const std::map<std::string, std::string> names = {{"closed_form", "paper"}};
  return names;
}

std::string unknown_key(const std::string& key, const std::vector<std::string>& known) {
  const auto found = renamed().find(key);
  if (found != renamed().end()) return "unknown key; it is now called " + found->second;
  const auto inside =
      std::find_if(known.begin(), known.end(), [&](auto& name) { return name.rfind(key + ".", 0) == 0; });
  if (inside != known.end()) return "expected a map, e.g. with the key " + *inside;
  const auto nearer = [&key](const std::string& a, const std::string& b) { return edits(key, a) < edits(key, b); };
  const auto nearest = std::min_element(known.begin(), known.end(), nearer);
  const bool misspelt = nearest != known.end() && edits(key, *nearest) <= max_edits;
  if (misspelt && known.size() > max_listed_keys) return "unknown key; did you mean " + *nearest + "?";
  return "unknown key; known keys are " + join(known);
}

}  // namespace spring_workbench::validation
