// Saved states as text, and sums of reports.
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "hand.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::simulation {
namespace {

const std::string format = "spring_workbench state 2";

std::vector<std::string> names_where(const decltype(AdvanceReport::ran)& set) {
  const char* const names[] = {"stretch", "bend",        "torsion",   "error_bound",
                               "gravity", "free_bodies", "collision", "movable_neighbours"};
  std::vector<std::string> found;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i]) found.emplace_back(names[i]);
  }
  return found;
}

}  // namespace

std::vector<ObjectEdit> SimulationState::edits() const {
  std::vector<ObjectEdit> edits;
  try {
    math::StateArchive head(words_);
    head(edits);
  } catch (const std::exception& error) {
    throw validation::InputError(std::string("state: not a saved state: ") + error.what());
  }
  return edits;
}

std::string serialise(const SimulationState& state) {
  std::string numbers;
  for (const std::uint64_t word : state.words_) numbers += math::to_hex(word);
  YAML::Emitter text;
  text << YAML::BeginMap << YAML::Key << "format" << YAML::Value << format << YAML::Key << "made_with" << YAML::Value
       << YAML::DoubleQuoted << state.origin_ << YAML::Key << "styluses" << YAML::Value << state.styluses_ << YAML::Key
       << "hash" << YAML::Value << YAML::DoubleQuoted << math::to_hex(state.hash()) << YAML::Key << "numbers"
       << YAML::Value << YAML::DoubleQuoted << numbers << YAML::EndMap;
  return text.c_str();
}

SimulationState parse_state(const std::string& text) {
  const std::string where = "state";
  YAML::Node map;
  try {
    map = YAML::Load(text);
  } catch (const YAML::Exception&) {
  }
  if (!map.IsMap()) validation::refuse_because("", where, "not a saved state");
  if (const std::string found = config::read_string(map["format"], where, "format"); found != format)
    validation::refuse(where, "format", found, format);
  SimulationState state;
  state.origin_ = config::read_string(map["made_with"], where, "made_with");
  state.styluses_ = config::read_integer(map["styluses"], where, "styluses", 1, 255);
  const auto words = math::words_of_hex(config::read_string(map["numbers"], where, "numbers"));
  if (words) state.words_ = *words;
  if (!words || config::read_string(map["hash"], where, "hash") != math::to_hex(state.hash())) {
    throw validation::InputError(where + ": numbers: damaged: they do not match the hash");
  }
  return state;
}

void add_to(AdvanceReport& report, const stepping::StepEstimates& e) {
  report.position_error = std::max(report.position_error, e.position);
  report.angle_error = std::max(report.angle_error, e.angle);
  report.stiffest_omega_dt = std::max(report.stiffest_omega_dt, e.omega_dt);
  report.steps += e.extra_steps;
  report.substeps += e.substeps;
  report.stops += e.stops;
  report.steps_fallback += e.fallback;
  report.energy_error += e.energy;
  report.local_error_bound = std::max(report.local_error_bound, e.bounds.local);
  report.error_bound = std::max(report.error_bound, e.bounds.position);
  report.angle_error_bound = std::max(report.angle_error_bound, e.bounds.angle);
  report.integrations_without_bound += e.bounds.unbounded;
}

void AdvanceReport::add(const AdvanceReport& later) {
  using R = AdvanceReport;
  const auto add = [&](auto... count) { ((this->*count += later.*count), ...); };
  const auto keep_larger = [&](auto... error) { ((this->*error = std::max(this->*error, later.*error)), ...); };
  add(&R::steps, &R::simulated_time, &R::substeps, &R::steps_fallback, &R::steps_rejected, &R::stops, &R::time_lost,
      &R::wrench_timeouts, &R::integrations_without_bound, &R::energy_error, &R::energy_balance, &R::steps_blocked,
      &R::steps_unsolved, &R::steps_among_movable, &R::collision_queries);
  keep_larger(&R::stiffest_omega_dt, &R::position_error, &R::angle_error, &R::local_error_bound, &R::error_bound,
              &R::angle_error_bound);
  ran |= later.ran;
}

std::vector<std::string> AdvanceReport::active() const { return names_where(ran); }
std::vector<std::string> AdvanceReport::skipped() const { return names_where(~ran); }

}  // namespace spring_workbench::simulation
