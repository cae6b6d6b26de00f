#include <yaml-cpp/yaml.h>

#include <cstddef>

#include "constants.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::simulation {
namespace {

const std::string format = "spring_workbench state 2";
const char* const hexadecimal = "0123456789abcdef";

void append_hex(std::string& text, std::uint64_t word) {
  for (int shift = 60; shift >= 0; shift -= 4) text += hexadecimal[(word >> shift) & 15u];
}

}  // namespace

std::string to_hex(std::uint64_t hash) {
  std::string text;
  append_hex(text, hash);
  return text;
}

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
  numbers.reserve(word_digits * state.words_.size());
  for (const std::uint64_t word : state.words_) append_hex(numbers, word);
  YAML::Emitter text;
  text << YAML::BeginMap << YAML::Key << "format" << YAML::Value << format << YAML::Key << "made_with" << YAML::Value
       << YAML::DoubleQuoted << state.origin_ << YAML::Key << "styluses" << YAML::Value << state.styluses_ << YAML::Key
       << "hash" << YAML::Value << YAML::DoubleQuoted << to_hex(state.hash()) << YAML::Key << "numbers" << YAML::Value
       << YAML::DoubleQuoted << numbers << YAML::EndMap;
  return text.c_str();
}

SimulationState parse_state(const std::string& text) {
  const std::string where = "state";
  YAML::Node map;
  try {
    map = YAML::Load(text);
  } catch (const YAML::Exception&) {
  }
  if (!map.IsMap() || config::read_string(map["format"], where, "format") != format) {
    validation::refuse(where, "format", format);
  }
  SimulationState state;
  state.origin_ = config::read_string(map["made_with"], where, "made_with");
  state.styluses_ = config::read_integer(map["styluses"], where, "styluses", 1, 255);
  const std::string numbers = config::read_string(map["numbers"], where, "numbers");
  const bool all_hexadecimal = numbers.find_first_not_of(hexadecimal) == std::string::npos;
  if (all_hexadecimal && numbers.size() % word_digits == 0) {
    for (std::size_t at = 0; at < numbers.size(); at += word_digits) {
      state.words_.push_back(std::stoull(numbers.substr(at, word_digits), nullptr, 16));
    }
  }
  if (!all_hexadecimal || numbers.size() % word_digits != 0 ||
      config::read_string(map["hash"], where, "hash") != to_hex(state.hash())) {
    throw validation::InputError(where + ": numbers: damaged: they do not match the hash");
  }
  return state;
}

}  // namespace spring_workbench::simulation
