#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace spring_workbench::hand_input {

/// The rules by which samples of a tracker are let through, filtered and followed. Keys `truth.*`.
struct TruthSettings {
  double quaternion_tolerance = 0.1;  ///< `quaternion_tolerance`: how far |q| may be from 1
  double max_distance = 1000.0;       ///< `max_distance` [m] from the origin of the tracker's frame
  double max_speed = 10.0;            ///< `max_speed` [m/s] between samples
  double max_turn_rate = 50.0;        ///< `max_turn_rate` [rad/s] between samples
  int accept_after = 5;               ///< `accept_after`: samples in a row that make a new place true
  double origin_radius = 1e-3;      ///< `origin_radius` [m]: a jump to the identity this close is "out of view"; 0: off
  double origin_angle = 0.02;       ///< `origin_angle` [rad]: … and turned from the identity by no more
  double min_cutoff = 0.0;          ///< `filter.min_cutoff` [Hz] of the jitter filter at rest; 0: off
  double beta = 5.0;                ///< `filter.beta` [Hz per m/s]: by which speed opens the filter
  double beta_angle = 1.0;          ///< `filter.beta_angle` [Hz per rad/s]
  double prediction = 0.0;          ///< `prediction` [s]: how far ahead of its stamp a pose is foretold; 0: off
  std::string lost = "freeze";      ///< `lost`: freeze or release, when samples stay away for `lost_after`
  double lost_after = 2.0;          ///< `lost_after` [s]
  double reengage_speed = 0.5;      ///< `reengage_speed` [m/s]: the most that catching up adds to the hand's speed
  double reengage_turn_rate = 2.0;  ///< `reengage_turn_rate` [rad/s]
};

/// What one key means; see `truth_descriptions`.
struct TruthDescription {
  std::string key;  ///< without "truth."
  std::string unit, allowed, default_value, meaning;
};
/// All keys. `doc/reference.md` is held to it.
std::vector<TruthDescription> truth_descriptions();

/// Takes the entries `truth: {…}` (nested) and `truth.…` (dotted) out of `map` and sets the fields that they name, all
/// or none. Throws InputError with `where`, key, value and rule for an unknown key, a wrong type or a value out of
/// range.
void take_truth_settings(YAML::Node& map, const std::string& where, TruthSettings& settings);

}  // namespace spring_workbench::hand_input
