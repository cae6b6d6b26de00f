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
  double quaternion_tolerance = 0.1;  ///< `quaternion_tolerance`: largest difference of |q| from 1
  double max_distance = 1000.0;       ///< `max_distance` [m]: largest distance from the origin of the tracker's frame
  double max_speed = 10.0;            ///< `max_speed` [m/s]: largest speed between samples
  double max_turn_rate = 50.0;        ///< `max_turn_rate` [rad/s]: largest rate of turn between samples
  int accept_after = 5;               ///< `accept_after`: number of consecutive samples that make a relocation
  double origin_radius = 1e-3;      ///< `origin_radius` [m]: a jump this close to the identity is "out of view"; 0: off
  double origin_angle = 0.02;       ///< `origin_angle` [rad]: largest rotation of such a jump from the identity
  double min_cutoff = 0.0;          ///< `smoothing.min_cutoff` [Hz]: cut-off of the One Euro filter at rest; 0: off
  double beta = 5.0;                ///< `smoothing.beta` [Hz per m/s]: increase of the cut-off with the speed
  double beta_angle = 1.0;          ///< `smoothing.beta_angle` [Hz per rad/s]: increase with the rate of turn
  double dead_band_distance = 0.0;  ///< `dead_band.distance` [m]: a hand that moves by less rests; 0: off
  double dead_band_angle = 0.0;     ///< `dead_band.angle` [rad]: a hand that turns by less rests; 0: off
  OnLoss on_loss = OnLoss::freeze;  ///< `on_loss`: treatment of the held object when its hand is lost
  double loss_timeout = 2.0;        ///< `loss_timeout` [s]: time without samples after which a hand is lost
  double reacquisition_speed = 0.5;      ///< `reacquisition_speed` [m/s]: speed of catching up, beyond the hand's
  double reacquisition_turn_rate = 2.0;  ///< `reacquisition_turn_rate` [rad/s]: turn rate, beyond the hand's
};

/// Description of one key; see input_descriptions().
struct InputDescription {
  std::string key;            ///< key without "input."
  std::string unit;           ///< SI unit, or "–"
  std::string allowed;        ///< allowed values, e.g. "a number > 0"
  std::string default_value;  ///< default value, as text
  std::string meaning;        ///< effect of the setting, in one line
};
/// Returns the descriptions of all keys of InputSettings, as in doc/reference.md.
std::vector<InputDescription> input_descriptions();

/// Takes the entries "input: {…}" (nested) and "input.…" (dotted) out of `map` and sets the fields that they name, all
/// or none. Throws InputError, with `where`, key, value and rule, for an unknown key, a wrong type or a value out of
/// range.
void take_input_settings(YAML::Node& map, const std::string& where, InputSettings& settings);

}  // namespace spring_workbench::hand_input
