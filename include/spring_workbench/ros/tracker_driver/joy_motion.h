#pragma once

#include <yaml-cpp/yaml.h>

#include <array>
#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::tracker_driver {

/// How a game pad or a 3D mouse moves the stylus.
struct JoySettings {
  std::array<int, 6> axes = {
      0, 1, 2, 3, 4, 5};     ///< `axes`: numbers of the axes for moving along x y z and turning about x y z; −1: none
  double move_speed = 0.25;  ///< `move_speed` [m/s] at full deflection, 0 … 2
  double turn_speed = 1.0;   ///< `turn_speed` [rad/s] at full deflection, 0 … 10
  double dead_zone = 0.1;    ///< `dead_zone`, 0 … 0.9 of full deflection: smaller deflections count as zero
  int grasp_button = 0;      ///< `grasp_button`: grasp while held; −1: none
  int tool_button = 1;       ///< `tool_button`: next tool; −1: none
  int clutch_button = 2;     ///< `clutch_button`: the hand moves without its tool while held; −1: none
};

/// The keys of read_joy_settings.
const std::vector<std::string>& joy_keys();
/// Reads the settings from a map; ignores other keys. Throws InputError with `where`, key, value and rule.
JoySettings read_joy_settings(const YAML::Node& map, const std::string& where);

/// A stylus frame B moved by joystick axes: each axis gives a velocity along or about an axis of the workbench W,
/// proportional to the deflection beyond the dead zone.
class JoyMotion {
 public:
  static constexpr double reach = 2.0;    ///< [m]; largest coordinate, to each side of the workbench's origin
  static constexpr double timeout = 0.5;  ///< [s] without input after which the stylus stops

  JoyMotion(const JoySettings& settings, const RigidTransform& X_WB) : settings_(settings), X_WB_(X_WB) {}

  /// Sets deflections, −1 … 1 (clamped; missing or non-finite ones count as zero), and buttons.
  void input(const std::vector<float>& axes, const std::vector<int>& buttons);
  /// Advances by `dt` [s] ≥ 0 and returns X_WB.
  const RigidTransform& advance(double dt);
  bool grasp() const { return grasp_; }
  bool next_tool() const { return next_tool_; }
  bool clutch() const { return clutch_; }

 private:
  double deflection(const std::vector<float>& axes, std::size_t i) const;

  JoySettings settings_;
  RigidTransform X_WB_;
  Twist V_WB_W_;
  double age_ = 0.0;  ///< age of the newest input [s]
  bool grasp_ = false, next_tool_ = false, clutch_ = false;
};

}  // namespace spring_workbench::tracker_driver
