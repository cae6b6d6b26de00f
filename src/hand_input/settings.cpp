#include "spring_workbench/hand_input/settings.h"

#include <sstream>
#include <variant>

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::hand_input {
namespace {

const std::string kGroup = "input";

validation::NumberRule positive_or_infinite() {
  validation::NumberRule rule = validation::positive();
  rule.infinity_allowed = true;
  return rule;
}

struct NumberField {
  double InputSettings::*field;
  validation::NumberRule rule;
};
struct CountField {
  int InputSettings::*field;
  int min, max;
};
struct OnLossField {
  OnLoss InputSettings::*field;
};

struct Entry {
  std::string key, unit, meaning;
  std::variant<NumberField, CountField, OnLossField> field;
};

const std::vector<Entry>& entries() {
  using T = InputSettings;
  static const std::vector<Entry> table = {
      {"quaternion_tolerance", "–", "how far a quaternion's norm may be from 1; within, it is normalised",
       NumberField{&T::quaternion_tolerance, validation::between(0.0, 0.99)}},
      {"max_distance", "m", "a position farther from the origin of its frame is left out",
       NumberField{&T::max_distance, validation::between(1e-3, 1e6)}},
      {"max_speed", "m/s", "a sample that could be reached only faster is left out",
       NumberField{&T::max_speed, positive_or_infinite()}},
      {"max_turn_rate", "rad/s", "likewise", NumberField{&T::max_turn_rate, positive_or_infinite()}},
      {"accept_after", "–", "so many samples in a row that fit to each other make the new place true",
       CountField{&T::accept_after, 1, 10000}},
      {"origin_radius", "m",
       "a pose this close to the frame's origin that the hand was not near is out of view; 0: off",
       NumberField{&T::origin_radius, validation::between(0.0, 1.0)}},
      {"origin_angle", "rad", "and turned by no more than this",
       NumberField{&T::origin_angle, validation::between(0.0, 3.15)}},
      {"smoothing.min_cutoff", "Hz", "cut-off of the One Euro filter at rest; 0: no filter",
       NumberField{&T::min_cutoff, validation::between(0.0, 1e4)}},
      {"smoothing.beta", "Hz/(m/s)", "by which speed raises the cut-off of the position",
       NumberField{&T::beta, validation::between(0.0, 1e6)}},
      {"smoothing.beta_angle", "Hz/(rad/s)", "by which turning raises the cut-off of the rotation",
       NumberField{&T::beta_angle, validation::between(0.0, 1e6)}},
      {"on_loss", "–",
       "after `input.loss_timeout`: freeze holds the object where the hand was last, release lets go of it",
       OnLossField{&T::on_loss}},
      {"loss_timeout", "s", "so long without a sample and the hand is lost",
       NumberField{&T::loss_timeout, validation::positive()}},
      {"reacquisition_speed", "m/s", "the most that catching up with a hand that is back adds to its speed",
       NumberField{&T::reacquisition_speed, positive_or_infinite()}},
      {"reacquisition_turn_rate", "rad/s", "likewise, of turning",
       NumberField{&T::reacquisition_turn_rate, positive_or_infinite()}},
  };
  return table;
}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

InputDescription describe(const Entry& entry) {
  const InputSettings defaults;
  InputDescription d{entry.key, entry.unit, "", "", entry.meaning};
  if (const auto* number = std::get_if<NumberField>(&entry.field)) {
    d.allowed = number->rule.text();
    d.default_value = text(defaults.*number->field);
  } else if (const auto* count = std::get_if<CountField>(&entry.field)) {
    d.allowed = "an integer in [" + std::to_string(count->min) + ", " + std::to_string(count->max) + "]";
    d.default_value = std::to_string(defaults.*count->field);
  } else {
    const auto& on_loss = std::get<OnLossField>(entry.field);
    d.allowed = "one of " + validation::join(validation::names<OnLoss>());
    d.default_value = validation::name_of(defaults.*on_loss.field);
  }
  return d;
}

void set(const std::string& key, const YAML::Node& value, const std::string& where, InputSettings& settings) {
  const std::string name = kGroup + "." + key;
  std::vector<std::string> known;
  for (const Entry& entry : entries()) {
    known.push_back(kGroup + "." + entry.key);
    if (entry.key != key) continue;
    if (const auto* number = std::get_if<NumberField>(&entry.field)) {
      settings.*number->field = config::read_number(value, where, name, number->rule);
    } else if (const auto* count = std::get_if<CountField>(&entry.field)) {
      settings.*count->field = config::read_integer(value, where, name, count->min, count->max);
    } else {
      const auto& on_loss = std::get<OnLossField>(entry.field);
      settings.*on_loss.field = config::read_named<OnLoss>(value, where, name);
    }
    return;
  }
  validation::refuse(where, name, "this key", "one of " + validation::join(known));
}

/// `value` under `key`: a map goes deeper, anything else is a value.
void set_all(const std::string& key, const YAML::Node& value, const std::string& where, InputSettings& settings) {
  if (!value.IsMap()) return set(key, value, where, settings);
  for (const auto& entry : value) {
    set_all((key.empty() ? "" : key + ".") + entry.first.Scalar(), entry.second, where, settings);
  }
}

}  // namespace

const std::vector<std::string>& names_of(OnLoss) {
  static const std::vector<std::string> names = {"freeze", "release"};
  return names;
}

std::vector<InputDescription> input_descriptions() {
  std::vector<InputDescription> descriptions;
  for (const Entry& entry : entries()) descriptions.push_back(describe(entry));
  return descriptions;
}

void take_input_settings(YAML::Node& map, const std::string& where, InputSettings& settings) {
  InputSettings result = settings;
  YAML::Node rest(YAML::NodeType::Map);
  for (const auto& entry : map) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (name == kGroup) {
      if (!entry.second.IsMap()) validation::refuse(where, kGroup, "this value", "a map of its keys");
      set_all("", entry.second, where, result);
    } else if (name.rfind(kGroup + ".", 0) == 0) {
      set_all(name.substr(kGroup.size() + 1), entry.second, where, result);
    } else {
      rest.force_insert(entry.first, entry.second);
    }
  }
  settings = result;
  map = rest;
}

}  // namespace spring_workbench::hand_input
