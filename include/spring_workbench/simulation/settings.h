#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/math/rigid_transform.h"
#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/rod/settings.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/settings.h"
#include "spring_workbench/tools/tool.h"

namespace YAML {
class Node;
}

namespace spring_workbench::simulation {

using rod::ForkChange;

/// Settings of a simulation, one field per key. setting_descriptions() and doc/reference.md explain each key.
struct SimulationSettings {
  std::optional<tools::Tool> tool;            ///< key `tool`; absent: the scene's tool
  std::optional<scene::ContactMode> contact;  ///< key `contact`; absent: the scene's contact mode
  std::optional<double> gravity;              ///< key `gravity` [m/s²], 0 … 1000; absent: the scene's gravity
  std::optional<double> force_scale;          ///< key `force_scale`, 1e-9 … 1e9; absent: the scene's scale
  bool massless = false;                      ///< key `massless`: whether all objects are without mass
  int styluses = 2;                           ///< key `styluses`, 1 … 255: number of hands
  double hand_scale = 1.0;                    ///< key `hand.scale`, 1e-3 … 1e3: factor on the hand's positions
  double hand_time_scale = 1.0;               ///< key `hand.time_scale`, 1e-3 … 1e3: world time per time of the hand
  int clutch_button = 2;                      ///< key `clutch.button`: index of the clutch's button, for nodes
  dynamics::DynamicsSettings dynamics;        ///< keys `integrator`, `step`, `tolerance`, `error_bound`, `inertia`
  rod::ForkSettings fork;                     ///< keys `shape`, `fork.…`
  tools::LimitSettings limit;                 ///< keys `limit.…`
  tools::GraspSettings grasp;  ///< keys `calibrate`, `calibration.…`, `grasp.…`, `start.follow`, `release`
  double dropout_after = 0.5;  ///< key `dropout_after` [s], > 0: longest gap between samples that is interpolated
  double external_wrench_timeout = 0.1;  ///< key `external_wrench_timeout` [s], 1e-3 … 10: how long a wrench acts
  int impact_bisections = 8;             ///< key `impact_bisections`, 0 … 30: to find an impact; 0: compute its time
};

/// Throws InputError, with `where`, key, value and rule, if a value or a combination of values is not allowed.
void validate(const SimulationSettings& settings, const std::string& where);

/// Converts a twist of the workbench (world axes) to the hand's scale of length and time, for a machine in its place.
inline Twist to_hand_units(const Twist& V_W, const SimulationSettings& s) {
  return {s.hand_time_scale / s.hand_scale * V_W.linear, s.hand_time_scale * V_W.angular};
}

/// A change of integrator, step or tolerance of all hands. Absent fields are not changed.
struct DynamicsChange {
  std::optional<dynamics::IntegratorKind> integrator;  ///< new integrator
  std::optional<double> step;                          ///< new largest step [s], 1e-6 … 1
  std::optional<double> tolerance;                     ///< new tolerance [m], 0 … 0.1; 0: fixed steps

  bool empty() const { return !integrator && !step && !tolerance; }                  ///< whether it changes nothing
  dynamics::DynamicsSettings applied_to(dynamics::DynamicsSettings dynamics) const;  ///< `dynamics` with this change
};

/// A change of one object of the scene while running, for Simulation::edit().
struct ObjectEdit {
  /// Adds or removes the object, moves it, or changes its mass or friction.
  enum class Action { add, move, remove, mass, friction };
  Action action = Action::move;  ///< the kind of change
  std::string name;              ///< name of the object
  std::string urdf;              ///< for `add`: path or package:// URI of the object's URDF
  /// For `move` and `add`: pose of the object's URDF link frame in world. Without it, an added object stands on the
  /// bench at x = y = 0.
  std::optional<RigidTransform> X_WL;
  double mass = 0.0;      ///< for `mass`: the new mass [kg], 0 … 1e12; an object of 0 kg is massless
  double friction = 0.0;  ///< for `friction`: the new Coulomb coefficient, ≥ 0

  bool operator==(const ObjectEdit& other) const;  ///< whether all fields are equal
  /// Saves or restores all fields.
  void archive(math::StateArchive& state) { state(action, name, urdf, X_WL, mass, friction); }
};
/// The words for the actions in messages, in their order.
inline std::vector<std::string> names_of(ObjectEdit::Action) { return {"add", "move", "remove", "mass", "friction"}; }

/// Throws InputError, with field, value and rule, if a value is invalid.
void validate(const ObjectEdit& edit);

/// Description of one key of SimulationSettings.
struct SettingDescription {
  std::string key;            ///< key, e.g. "fork.stiffness.bend"
  std::string type;           ///< type: bool, int, double, string or double list
  std::string unit;           ///< SI unit, or "–"
  std::string allowed;        ///< allowed values, e.g. "a number > 0"
  std::string default_value;  ///< default value, as text
  std::string meaning;        ///< effect of the setting, in one line
};
std::vector<SettingDescription> setting_descriptions();  ///< descriptions of all settings

/// Sets the fields given in `values` (a YAML map, nested or with dotted keys), all or none. Throws InputError, with
/// `where`, key, value and rule, for an unknown key, a wrong type or a value out of range.
void apply_settings(const YAML::Node& values, const std::string& where, SimulationSettings& settings);

}  // namespace spring_workbench::simulation
