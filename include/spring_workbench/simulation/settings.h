#pragma once

#include <functional>
#include <string>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/rod/settings.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/tools/settings.h"

namespace YAML {
class Node;
}

namespace spring_workbench::simulation {

/// Everything that can be set from outside about a simulation. One field per key; the keys with unit, range and meaning
/// are in `setting_descriptions()`, which the parameter server, `replay` and the reference in doc/ are all made from.
struct SimulationSettings {
  std::string tool = "";                ///< key `tool`; empty: as the scene says
  std::string contact = "";             ///< key `contact`; none, stop, dynamic; empty: as the scene says
  double gravity = -1.0;                ///< key `gravity` [m/s²]; negative: as the scene says
  double force_scale = -1.0;            ///< key `force_scale`; negative: as the scene says
  dynamics::DynamicsSettings dynamics;  ///< keys `integrator`, `step`, `tolerance`, `inertia`
  rod::ForkSettings fork;               ///< keys `shape`, `fork.*`
  tools::LimitSettings limit;           ///< keys `limit.*`
  tools::GraspSettings grasp;           ///< keys `calibrate`, `grasp.*`, `start.follow`, `release`
  double dropout_after = 0.5;           ///< key `dropout_after` [s]
  int bisection_levels = 8;             ///< key `bisection_levels`; 0 … 30 (paper, section 5); 0: time of impact
};

/// Throws InputError for an unknown damping law, or one that the damping ratios do not go with (doc/model.md,
/// "Damping").
void check_damping(const std::string& where, const rod::ForkSettings& fork);

/// Which tolerances `integrator` may be given [m]; 0: fixed steps.
validation::NumberRule allowed_tolerance();

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
