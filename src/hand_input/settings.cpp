#include "spring_workbench/hand_input/settings.h"

#include <functional>
#include <sstream>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::hand_input {
namespace {

const std::string kGroup = "input";

/// A row of the table of settings.
struct Entry {
  InputSettingDescription description;
  std::function<void(const YAML::Node&, const std::string& where, const std::string& name, InputSettings&)> read;
};

Entry number(const std::string& key, const char* unit, const validation::NumberRule& rule, const std::string& meaning,
             double InputSettings::*field) {
  std::ostringstream default_value;
  default_value << InputSettings().*field;
  return {{key, unit, rule.text(), default_value.str(), meaning},
          [=](const auto& node, const auto& where, const auto& name, InputSettings& settings) {
            settings.*field = config::read_number(node, where, name, rule.in(unit));
          }};
}

const std::vector<Entry>& entries() {
  using T = InputSettings;
  using validation::between;
  using validation::positive_or_infinite;
  static const std::vector<Entry> table = {
      number("quaternion_tolerance", "–", between(0.0, 0.99),
             "how far the norm of a quaternion may be from 1; it is then normalised", &T::quaternion_tolerance),
      number("max_distance", "m", between(1e-3, 1e6), "a position farther from the origin of its frame is rejected",
             &T::max_distance),
      number("max_speed", "m/s", positive_or_infinite(), "a sample that would need a higher speed is rejected",
             &T::max_speed),
      number("max_turn_rate", "rad/s", positive_or_infinite(),
             "a sample that would need a higher turn rate is rejected", &T::max_turn_rate),
      {{"accept_after", "–", "an integer between 1 and 10000", std::to_string(T().accept_after),
        "number of consecutive samples that must agree with each other before the new position is accepted"},
       [](const auto& node, const auto& where, const auto& name, T& settings) {
         settings.accept_after = config::read_integer(node, where, name, 1, 10000);
       }},
      number("origin_radius", "m", between(0.0, 1.0),
             "a sample counts as out of view if its position is this close to the origin of the frame, its rotation is "
             "within input.origin_angle of the identity, and the hand was not near the origin before; 0: off",
             &T::origin_radius),
      number("origin_angle", "rad", between(0.0, 3.15),
             "the angle from the identity that goes with input.origin_radius", &T::origin_angle),
      number("smoothing.min_cutoff", "Hz", between(0.0, 1e4), "cut-off of the One Euro filter at rest; 0: no filter",
             &T::min_cutoff),
      number("smoothing.beta", "Hz/(m/s)", between(0.0, 1e6), "increase of the cut-off of the position with speed",
             &T::beta),
      number("smoothing.beta_angle", "Hz/(rad/s)", between(0.0, 1e6),
             "increase of the cut-off of the rotation with angular speed", &T::beta_angle),
      number("dead_band.distance", "m", between(0.0, 0.1),
             "a hand that stays within this distance of one pose for 0.3 s counts as at rest until it leaves it, so "
             "that the object it holds can sleep; choose more than the tracker's noise; 0: off",
             &T::dead_band_distance),
      number("dead_band.angle", "rad", between(0.0, 0.5), "the same for its rotation; 0: off", &T::dead_band_angle),
      {{"on_loss", "–", "one of " + validation::join(names_of(OnLoss())), validation::name_of(T().on_loss),
        "after `input.loss_timeout`: freeze: the hand counts as at rest at its last pose and holds the object there; "
        "release: the object is "
        "released"},
       [](const auto& node, const auto& where, const auto& name, T& settings) {
         settings.on_loss = config::read_named<OnLoss>(node, where, name);
       }},
      number("loss_timeout", "s", validation::positive(), "time without a sample after which the hand counts as lost",
             &T::loss_timeout),
      number("reacquisition_speed", "m/s", positive_or_infinite(),
             "the largest speed that catching up with a returned hand may add to its own speed",
             &T::reacquisition_speed),
      number("reacquisition_turn_rate", "rad/s", positive_or_infinite(),
             "the largest turn rate that catching up with a returned hand may add to its own",
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
  validation::refuse_because(config::place(value, where), name, validation::unknown_key(name, known));
}

/// Sets `value` under `key`; a map is a group of further keys.
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

std::vector<InputSettingDescription> input_descriptions() {
  std::vector<InputSettingDescription> descriptions;
  for (const Entry& entry : entries()) descriptions.push_back(entry.description);
  return descriptions;
}

void take_input_settings(YAML::Node& map, const std::string& where, InputSettings& settings) {
  InputSettings result = settings;
  YAML::Node rest(YAML::NodeType::Map);
  for (const auto& entry : map) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (name == kGroup) {
      if (!entry.second.IsMap()) {
        validation::refuse(config::place(entry.second, where), kGroup, YAML::Dump(entry.second), "a map of its keys");
      }
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
