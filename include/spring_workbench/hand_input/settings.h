#pragma once

#include <string>
#include <vector>

namespace YAML {
class Node;
}

namespace spring_workbench::hand_input {

/// Treatment of a held object whose hand is lost.
enum class OnLoss {
  freeze,   ///< the hand counts as resting where it was last
  release,  ///< the object is released
};
const std::vector<std::string>& names_of(OnLoss);  ///< words for the treatments in settings

/// How the samples of a tracker are accepted, filtered and followed. Keys: `input.…`; ranges: input_descriptions().
struct InputSettings {
  /// Key `quaternion_tolerance`, 0 … 0.99: largest difference of |q| from 1.
  double quaternion_tolerance = 0.1;
  /// Key `max_distance` [m], 1e-3 … 1e6: largest distance from the origin of the tracker's frame.
  double max_distance = 1000.0;
  double max_speed = 10.0;      ///< key `max_speed` [m/s], > 0: largest speed between samples
  double max_turn_rate = 50.0;  ///< key `max_turn_rate` [rad/s], > 0: largest rate of turn between samples
  int accept_after = 5;         ///< key `accept_after`, 1 … 10,000: consecutive samples that make a relocation
  /// Key `origin_radius` [m], 0 … 1: a jump that ends this close to the identity means "out of view"; 0: off.
  double origin_radius = 1e-3;
  double origin_angle = 0.02;  ///< key `origin_angle` [rad], 0 … 3.15: its largest rotation from the identity
  /// Key `smoothing.min_cutoff` [Hz], 0 … 10,000: cut-off frequency of the One Euro filter at rest; 0: off.
  double min_cutoff = 0.0;
  double beta = 5.0;        ///< key `smoothing.beta` [Hz per m/s], 0 … 1e6: increase of the cut-off with the speed
  double beta_angle = 1.0;  ///< key `smoothing.beta_angle` [Hz per rad/s], 0 … 1e6: increase with the rate of turn
  double dead_band_distance = 0.0;  ///< key `dead_band.distance` [m], 0 … 0.1: a hand that moves by less rests; 0: off
  double dead_band_angle = 0.0;     ///< key `dead_band.angle` [rad], 0 … 0.5: a hand that turns by less rests; 0: off
  OnLoss on_loss = OnLoss::freeze;  ///< key `on_loss`: treatment of the held object when its hand is lost
  double loss_timeout = 2.0;        ///< key `loss_timeout` [s], > 0: time without samples after which a hand is lost
  /// Key `reacquisition_speed` [m/s], > 0: speed of catching up with a hand that is back, beyond its own.
  double reacquisition_speed = 0.5;
  double reacquisition_turn_rate = 2.0;  ///< key `reacquisition_turn_rate` [rad/s], > 0: rate of turn likewise
};

/// Description of one key; see input_descriptions().
struct InputSettingDescription {
  std::string key;            ///< key without "input."
  std::string unit;           ///< SI unit, or "–"
  std::string allowed;        ///< allowed values, e.g. "a number > 0"
  std::string default_value;  ///< default value, as text
  std::string meaning;        ///< effect of the setting, in one line
};
/// Returns the descriptions of all keys of InputSettings, as in doc/reference.md.
std::vector<InputSettingDescription> input_descriptions();

/// Takes the entries "input: {…}" (nested) and "input.…" (dotted) out of `map` and sets the fields that they name, all
/// or none. Throws InputError, with `where`, key, value and rule, for an unknown key, a wrong type or a value out of
/// range.
void take_input_settings(YAML::Node& map, const std::string& where, InputSettings& settings);

}  // namespace spring_workbench::hand_input
