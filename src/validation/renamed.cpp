#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::validation {

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
  };
  return names;
}

const std::map<std::string, std::string>& renamed_values() {
  static const std::map<std::string, std::string> names = {{"closed_form", "paper"}};
  return names;
}

std::string unknown_key(const std::string& key, const std::string& known) {
  const auto found = renamed().find(key);
  return found != renamed().end() ? "unknown key; it is now called " + found->second
                                  : "unknown key; known keys are " + known;
}

}  // namespace spring_workbench::validation
