#include "spring_workbench/ros/tracker_driver/joy_motion.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::tracker_driver {
namespace {

bool is_down(const std::vector<int>& buttons, int number) {
  return number >= 0 && static_cast<std::size_t>(number) < buttons.size() &&
         buttons[static_cast<std::size_t>(number)] != 0;
}

std::array<int, 6> read_axes(const YAML::Node& node, const std::string& where) {
  const std::vector<double> numbers = config::read_numbers(node, where, "axes", 6);
  std::array<int, 6> axes{};
  for (std::size_t i = 0; i < 6; ++i) {
    if (!(numbers[i] >= -1.0 && numbers[i] < max_controls && numbers[i] == std::floor(numbers[i]))) {
      validation::refuse(where, "axes", validation::number_text(numbers[i]), "an integer between -1 (none) and 63");
    }
    axes[i] = static_cast<int>(numbers[i]);
  }
  return axes;
}

}  // namespace

const std::vector<std::string>& joy_keys() {
  static const std::vector<std::string> keys{"axes",         "move_speed",  "turn_speed",   "dead_zone",
                                             "grasp_button", "tool_button", "clutch_button"};
  return keys;
}

JoySettings read_joy_settings(const YAML::Node& map, const std::string& where) {
  JoySettings settings;
  const auto number = [&](const char* key, double max, const char* unit, double& value) {
    if (map[key]) value = config::read_number(map[key], where, key, validation::between(0.0, max).in(unit));
  };
  const auto button = [&](const char* key, int& value) {
    if (map[key]) value = config::read_integer(map[key], where, key, -1, max_controls - 1);
  };
  if (map["axes"]) settings.axes = read_axes(map["axes"], where);
  number("move_speed", 2.0, "m/s", settings.move_speed);
  number("turn_speed", 10.0, "rad/s", settings.turn_speed);
  number("dead_zone", 0.9, "", settings.dead_zone);
  button("grasp_button", settings.grasp_button);
  button("tool_button", settings.tool_button);
  button("clutch_button", settings.clutch_button);
  return settings;
}

double JoyMotion::deflection(const std::vector<float>& axes, std::size_t i) const {
  const int axis = settings_.axes[i];
  if (axis < 0 || static_cast<std::size_t>(axis) >= axes.size()) return 0.0;
  const double value = static_cast<double>(axes[static_cast<std::size_t>(axis)]);
  if (!std::isfinite(value)) return 0.0;
  const double beyond = (std::abs(value) - settings_.dead_zone) / (1.0 - settings_.dead_zone);
  return std::copysign(std::clamp(beyond, 0.0, 1.0), value);
}

void JoyMotion::input(const std::vector<float>& axes, const std::vector<int>& buttons) {
  for (std::size_t i = 0; i < 3; ++i) {
    V_WB_W_.linear[static_cast<Eigen::Index>(i)] = settings_.move_speed * deflection(axes, i);
    V_WB_W_.angular[static_cast<Eigen::Index>(i)] = settings_.turn_speed * deflection(axes, i + 3);
  }
  grasp_ = is_down(buttons, settings_.grasp_button);
  next_tool_ = is_down(buttons, settings_.tool_button);
  clutch_ = is_down(buttons, settings_.clutch_button);
  age_ = 0.0;
}

const RigidTransform& JoyMotion::advance(double dt) {
  age_ += dt;
  if (age_ > timeout) return X_WB_;
  const Vector3d p = X_WB_.translation() + dt * V_WB_W_.linear;
  const Quaterniond q(math::exp_so3(dt * V_WB_W_.angular) * X_WB_.linear());
  X_WB_ = make_transform(p.cwiseMax(-reach).cwiseMin(reach), q);
  return X_WB_;
}

}  // namespace spring_workbench::tracker_driver
