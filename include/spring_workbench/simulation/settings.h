#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/rod/settings.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/settings.h"
#include "spring_workbench/tools/tool.h"

namespace YAML {
class Node;
}

namespace spring_workbench::simulation {

/// Everything that can be set from outside about a simulation. One field per key; the keys with unit, range and meaning
/// are in `setting_descriptions()`, which the parameter server, `replay` and the reference in doc/ are all made from.
struct SimulationSettings {
  std::optional<tools::Tool> tool;            ///< key `tool`; default: as in the scene; likewise the next three
  std::optional<scene::ContactMode> contact;  ///< key `contact`
  std::optional<double> gravity;              ///< key `gravity` [m/s²], 0 … 1000
  std::optional<double> force_scale;          ///< key `force_scale`, 1e-9 … 1e9
  bool massless = false;                      ///< key `massless`: no object has mass
  double hand_scale = 1.0;                    ///< key `hand.scale`, 1e-3 … 1e3
  int clutch_button = 2;                      ///< key `clutch.button`, of the stylus' Joy
  dynamics::DynamicsSettings dynamics;        ///< keys `integrator`, `step`, `tolerance`, `inertia`
  rod::ForkSettings fork;                     ///< keys `shape`, `fork.*`
  tools::LimitSettings limit;                 ///< keys `limit.*`
  tools::GraspSettings grasp;                 ///< keys `calibrate`, `grasp.*`, `start.follow`, `release`
  double dropout_after = 0.5;                 ///< key `dropout_after` [s]
  double wrench_timeout = 0.1;                ///< key `external_wrench_timeout` [s]
  int bisection_levels = 8;  ///< key `bisection_levels`; 0 … 30 (paper, section 5); 0: time of impact
};

/// Throws InputError naming `where`, key, value and rule for a value that its key does not allow, or for damping ratios
/// that the damping law does not allow.
void validate(const SimulationSettings& settings, const std::string& where);

/// A change of the fork while running; absent fields stay as they are.
struct ForkChange {
  std::optional<rod::ForkDofs> dofs;
  std::optional<double> stretch_stiffness, bend_stiffness;  ///< [N/m]
  std::optional<double> torsion_stiffness;                  ///< [N·m/rad]
  std::optional<rod::PerDof> damping_ratio;                 ///< –
  std::optional<rod::PerDof> damping_coefficient;           ///< [N·s/m, N·s/m, N·m·s/rad]
  std::optional<rod::DampingLaw> damping_law;

  bool empty() const { return !dofs && !changes_springs(); }
  bool changes_springs() const;
  /// The fork with this change.
  rod::ForkSettings applied_to(rod::ForkSettings fork) const;
};

/// The change that makes a fork like this one, except for its shape and length.
ForkChange change_to(const rod::ForkSettings& fork);

/// A change of how time is stepped.
struct DynamicsChange {
  std::optional<dynamics::IntegratorKind> integrator;
  std::optional<double> step;       ///< [s]
  std::optional<double> tolerance;  ///< [m]; 0: fixed steps

  bool empty() const { return !integrator && !step && !tolerance; }
  dynamics::DynamicsSettings applied_to(dynamics::DynamicsSettings dynamics) const;
};

/// A change of one object of the scene while running.
struct ObjectEdit {
  enum class Action { add, move, remove, mass, friction };
  Action action = Action::move;
  std::string object;                  ///< its name
  std::string urdf;                    ///< add: the object's own, a path or package:// URI
  std::optional<RigidTransform> X_WL;  ///< pose of its URDF link's frame in world; move: needed; add without: on the
                                       ///< bench at x = y = 0
  double mass = 0.0;                   ///< mass: the new one [kg], 0 … 1e12; 0: follows the tip as a massless one
  double friction = 0.0;               ///< friction: the new Coulomb coefficient, ≥ 0

  bool operator==(const ObjectEdit& other) const;
  void exchange(math::StateArchive& state) { state(action, object, urdf, X_WL, mass, friction); }
};
inline std::vector<std::string> names_of(ObjectEdit::Action) { return {"add", "move", "remove", "mass", "friction"}; }

/// Throws InputError naming `edit_object`, field, value and rule for a value that no object can have.
void validate(const ObjectEdit& edit);

/// What one key means.
struct SettingDescription {
  std::string key;      ///< e.g. "fork.stiffness.bend"
  std::string type;     ///< bool, int, double, string, double list
  std::string unit;     ///< SI unit, or "–"
  std::string allowed;  ///< e.g. "> 0"
  std::string default_value;
  std::string meaning;
};
std::vector<SettingDescription> setting_descriptions();

/// Sets the fields that `values` (a YAML map, nested or with dotted keys) names, all or none.
/// Throws InputError naming `where`, key, value and rule for an unknown key, a wrong type or a value out of range.
void apply_settings(const YAML::Node& values, const std::string& where, SimulationSettings& settings);

}  // namespace spring_workbench::simulation
