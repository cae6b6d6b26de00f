#include "spring_workbench/hand_input/settings.h"

#include <functional>
#include <sstream>

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::hand_input {
namespace {

const std::string kGroup = "input";

validation::NumberRule positive_or_infinite() {
  validation::NumberRule rule = validation::positive();
  rule.infinity_allowed = true;
  return rule;
}

/// One row of the table.
struct Entry {
  InputDescription description;
  std::function<void(const YAML::Node&, const std::string& where, const std::string& name, InputSettings&)> read;
};

Entry number(const std::string& key, const std::string& unit, const validation::NumberRule& rule,
             const std::string& meaning, double InputSettings::*field) {
  std::ostringstream default_value;
  default_value << InputSettings().*field;
  return {{key, unit, rule.text(), default_value.str(), meaning},
          [=](const auto& node, const auto& where, const auto& name, InputSettings& settings) {
            settings.*field = config::read_number(node, where, name, rule);
          }};
}

const std::vector<Entry>& entries() {
  using T = InputSettings;
  using validation::between;
  static const std::vector<Entry> table = {
      number("quaternion_tolerance", "–", between(0.0, 0.99),
             "how far a quaternion's norm may be from 1; within, it is normalised", &T::quaternion_tolerance),
      number("max_distance", "m", between(1e-3, 1e6), "a position farther from the origin of its frame is rejected",
             &T::max_distance),
      number("max_speed", "m/s", positive_or_infinite(), "a sample that could be reached only faster is rejected",
             &T::max_speed),
      number("max_turn_rate", "rad/s", positive_or_infinite(), "likewise", &T::max_turn_rate),
      {{"accept_after", "–", "an integer in [1, 10000]", std::to_string(T().accept_after),
        "so many samples in a row that fit to each other make the new place true"},
       [](const auto& node, const auto& where, const auto& name, T& settings) {
         settings.accept_after = config::read_integer(node, where, name, 1, 10000);
       }},
      number("origin_radius", "m", between(0.0, 1.0),
             "a pose this close to the frame's origin that the hand was not near is out of view; 0: off",
             &T::origin_radius),
      number("origin_angle", "rad", between(0.0, 3.15), "and turned by no more than this", &T::origin_angle),
      number("smoothing.min_cutoff", "Hz", between(0.0, 1e4), "cut-off of the One Euro filter at rest; 0: no filter",
             &T::min_cutoff),
      number("smoothing.beta", "Hz/(m/s)", between(0.0, 1e6), "by which speed raises the cut-off of the position",
             &T::beta),
      number("smoothing.beta_angle", "Hz/(rad/s)", between(0.0, 1e6),
             "by which turning raises the cut-off of the rotation", &T::beta_angle),
      {{"on_loss", "–", "one of " + validation::join(names_of(OnLoss())), validation::name_of(T().on_loss),
        "after `input.loss_timeout`: freeze holds the object where the hand was last, release lets go of it"},
       [](const auto& node, const auto& where, const auto& name, T& settings) {
         settings.on_loss = config::read_named<OnLoss>(node, where, name);
       }},
      number("loss_timeout", "s", validation::positive(), "so long without a sample and the hand is lost",
             &T::loss_timeout),
      number("reacquisition_speed", "m/s", positive_or_infinite(),
             "the most that catching up with a hand that is back adds to its speed", &T::reacquisition_speed),
      number("reacquisition_turn_rate", "rad/s", positive_or_infinite(), "likewise, of turning",
             &T::reacquisition_turn_rate),
  };
  return table;
}

void set(const std::string& key, const YAML::Node& value, const std::string& where, InputSettings& settings) {
  const std::string name = kGroup + "." + key;
  std::vector<std::string> known;
  for (const Entry& entry : entries()) {
    if (entry.description.key == key) return entry.read(value, where, name, settings);
    known.push_back(kGroup + "." + entry.description.key);
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
  for (const Entry& entry : entries()) descriptions.push_back(entry.description);
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
