#include "spring_workbench/simulation/settings.h"

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>
#include <utility>

#include "spring_workbench/dynamics/step_control.h"
#include "spring_workbench/rod/shape_model.h"
#include "spring_workbench/tools/tool.h"
#include "spring_workbench/validation/one_line.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::simulation {
namespace {

using Choices = std::vector<std::string>;
using S = SimulationSettings;
const Choices damping_laws = {"per_dof", "modal"};
/// Where a setting's value is kept. A captureless lambda, so that the table below stays a table.
template <typename T>
using Member = T& (*)(S&);

struct Field {
  SettingDescription description;
  std::function<void(const YAML::Node&, const std::string& where, S&)> read;
};

std::string text_of(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

Field number(const std::string& key, const std::string& unit, const validation::NumberRule& rule,
             const std::string& meaning, Member<double> member) {
  S defaults;
  return {{key, "double", unit, rule.text(), text_of(member(defaults)), meaning},
          [=](const YAML::Node& node, const std::string& where, S& s) {
            member(s) = config::read_number(node, where, key, rule);
          }};
}

Field integer(const std::string& key, int min, int max, const std::string& meaning, Member<int> member) {
  S defaults;
  const std::string allowed = "an integer in [" + std::to_string(min) + ", " + std::to_string(max) + "]";
  return {{key, "int", "–", allowed, std::to_string(member(defaults)), meaning},
          [=](const YAML::Node& node, const std::string& where, S& s) {
            member(s) = config::read_integer(node, where, key, min, max);
          }};
}

Field flag(const std::string& key, const std::string& meaning, Member<bool> member) {
  S defaults;
  return {
      {key, "bool", "–", "true or false", member(defaults) ? "true" : "false", meaning},
      [=](const YAML::Node& node, const std::string& where, S& s) { member(s) = config::read_bool(node, where, key); }};
}

Field choice(const std::string& key, const Choices& choices, const std::string& meaning, Member<std::string> member) {
  S defaults;
  return {{key, "string", "–", "one of " + validation::join(choices), member(defaults), meaning},
          [=](const YAML::Node& node, const std::string& where, S& s) {
            member(s) = config::read_choice(node, where, key, choices);
          }};
}

Field name(const std::string& key, const std::string& allowed, const std::string& meaning, Member<std::string> member) {
  S defaults;
  return {{key, "string", "–", allowed, member(defaults), meaning},
          [=](const YAML::Node& node, const std::string& where, S& s) {
            member(s) = config::read_string(node, where, key);
          }};
}

Field pose(const std::string& key, const std::string& meaning, Member<std::optional<RigidTransform>> member) {
  return {
      {key, "double list", "m, –", "x y z qx qy qz qw, the quaternion not zero", "", meaning},
      [=](const YAML::Node& node, const std::string& where, S& s) { member(s) = config::read_pose(node, where, key); }};
}

/// `field`, whose default is no value of its own but what `text` says.
Field by_default(const std::string& text, Field field) {
  field.description.default_value = text;
  return field;
}

validation::NumberRule positive_or_infinite() {
  validation::NumberRule rule = validation::positive();
  rule.infinity_allowed = true;
  return rule;
}

std::vector<Field> scene_fields() {
  const std::string as_scene = "as the scene says";
  return {
      by_default(as_scene, choice("tool", tools::tool_names(), "the tool in the hand",
                                  [](S& s) -> std::string& { return s.tool; })),
      by_default(as_scene,
                 choice("contact", {"none", "stop", "dynamic"},
                        "none: nothing is felt; stop: the held object stops at everything else and slides on; "
                        "dynamic: it pushes, lifts and carries what it touches",
                        [](S& s) -> std::string& { return s.contact; })),
      by_default(as_scene, number("gravity", "m/s²", validation::between(0.0, 1e3), "along −z of world",
                                  [](S& s) -> double& { return s.gravity; })),
      by_default(as_scene, number("force_scale", "–", validation::between(1e-9, 1e9), "virtual per real unit of force",
                                  [](S& s) -> double& { return s.force_scale; })),
  };
}

std::vector<Field> dynamics_fields() {
  return {
      choice("integrator", dynamics::integrator_names(), "how the fork and the held object are stepped",
             [](S& s) -> std::string& { return s.dynamics.integrator; }),
      number("step", "s", validation::between(1e-6, 1.0),
             "the largest step; a step also ends at every sample of the motion",
             [](S& s) -> double& { return s.dynamics.step; }),
      number("tolerance", "m", allowed_tolerance(),
             "0: fixed steps; else steps are made short enough for the run's error to stay near this",
             [](S& s) -> double& { return s.dynamics.tolerance; }),
      choice("inertia", {"exact", "point_mass"}, "exact: the object's own; point_mass: the paper's I = r² m",
             [](S& s) -> std::string& { return s.dynamics.inertia; }),
  };
}

std::vector<Field> fork_fields() {
  const validation::NumberRule stiffness = validation::between(0.0, 1e15);
  const validation::NumberRule ratio = validation::between(0.0, 10.0);
  return {
      choice("shape", rod::shape_model_names(), "the fork's shape model: how its curvature may vary along it",
             [](S& s) -> std::string& { return s.fork.shape; }),
      number("fork.length", "m", validation::between(1e-4, 1e3), "rest length",
             [](S& s) -> double& { return s.fork.length; }),
      number("fork.stiffness.stretch", "N/m", stiffness, "axial force per extension",
             [](S& s) -> double& { return s.fork.stiffness.stretch; }),
      number("fork.stiffness.bend", "N/m", stiffness, "transverse tip force per tip deflection",
             [](S& s) -> double& { return s.fork.stiffness.bend; }),
      number("fork.stiffness.torsion", "N·m/rad", stiffness, "axial moment per twist angle",
             [](S& s) -> double& { return s.fork.stiffness.torsion; }),
      number("fork.damping.stretch", "–", ratio, "damping ratio of stretching; 1 is critical",
             [](S& s) -> double& { return s.fork.damping_ratio.stretch; }),
      number("fork.damping.bend", "–", ratio, "damping ratio of bending; 1 is critical",
             [](S& s) -> double& { return s.fork.damping_ratio.bend; }),
      number("fork.damping.torsion", "–", ratio, "damping ratio of twisting; 1 is critical",
             [](S& s) -> double& { return s.fork.damping_ratio.torsion; }),
      choice("fork.damping_law", damping_laws,
             "per_dof: Kelvin–Voigt, the ratio that of each family alone; modal: every mode of the held object has the "
             "ratio, which must be the same for all families",
             [](S& s) -> std::string& { return s.fork.damping_law; }),
      flag("fork.dofs.stretch", "the fork stretches; false: rigid", [](S& s) -> bool& { return s.fork.dofs.stretch; }),
      flag("fork.dofs.bend", "the fork bends; false: rigid", [](S& s) -> bool& { return s.fork.dofs.bend; }),
      flag("fork.dofs.torsion", "the fork twists; false: rigid", [](S& s) -> bool& { return s.fork.dofs.torsion; }),
      by_default(".inf", number("limit.force", "N", positive_or_infinite(),
                                "what would take a larger force at the tip than this is let go",
                                [](S& s) -> double& { return s.limit.force; })),
      by_default(".inf", number("limit.moment", "N·m", positive_or_infinite(),
                                "what would take a larger moment at the tip than this is let go",
                                [](S& s) -> double& { return s.limit.moment; })),
      number("fork.switch_off_time", "s", validation::between(1e-6, 1e3),
             "time constant on which a family that is switched off while strained goes back to zero strain",
             [](S& s) -> double& { return s.fork.switch_off_time; }),
  };
}

std::vector<Field> grasp_fields() {
  return {
      flag("calibrate", "size, springs and dampers of the tool from the object and its grasp, on every grasp",
           [](S& s) -> bool& { return s.grasp.calibrate; }),
      by_default("none: grasped by button", name("grasp.object", "the name of a movable object of the scene",
                                                 "this object is held from the first sample to the last",
                                                 [](S& s) -> std::string& { return s.grasp.object; })),
      by_default("where the tip is when it grasps",
                 pose("grasp.tip_in_object", "the tip frame in the object's centre-of-mass frame",
                      [](S& s) -> std::optional<RigidTransform>& { return s.grasp.X_OE; })),
      flag("start.follow", "move the object so that the grasp fits the first pose of the handle",
           [](S& s) -> bool& { return s.grasp.start_follow; }),
      choice("release", {"thrown", "dropped"},
             "a released object keeps its velocity (thrown) or is set to rest (dropped)",
             [](S& s) -> std::string& { return s.grasp.release; }),
  };
}

std::vector<Field> other_fields() {
  return {
      number("dropout_after", "s", positive_or_infinite(),
             "a longer gap between samples holds the handle still until the next one",
             [](S& s) -> double& { return s.dropout_after; }),
      integer("bisection_levels", 0, 30,
              "how often the end of a step that touches is halved (the paper, section 5); 0: time of impact instead",
              [](S& s) -> int& { return s.bisection_levels; }),
  };
}

/// Every key there is: the one table.
std::vector<Field> make_fields() {
  std::vector<Field> all;
  for (auto group : {scene_fields, dynamics_fields, fork_fields, grasp_fields, other_fields}) {
    for (Field& field : group()) all.push_back(std::move(field));
  }
  return all;
}

const std::vector<Field>& fields() {
  static const std::vector<Field> all = make_fields();
  return all;
}

using KeyAndValue = std::pair<std::string, YAML::Node>;

/// `{a: {b: 1}, c.d: 2}` as `a.b: 1`, `c.d: 2`.
void flatten(const YAML::Node& map, const std::string& where, const std::string& prefix,
             std::vector<KeyAndValue>& values) {
  for (const auto& entry : map) {
    const std::string key = prefix + config::read_string(entry.first, where, prefix + "(key)");
    if (entry.second.IsMap()) {
      flatten(entry.second, where, key + ".", values);
    } else {
      values.emplace_back(key, entry.second);
    }
  }
}

const Field& find_field(const std::string& key, const std::string& where) {
  const auto found =
      std::find_if(fields().begin(), fields().end(), [&](const Field& field) { return field.description.key == key; });
  if (found != fields().end()) return *found;
  Choices known;
  for (const Field& field : fields()) known.push_back(field.description.key);
  throw validation::InputError(
      validation::one_line(where + ": " + key + ": " + validation::unknown_key(key, validation::join(known))));
}

}  // namespace

void check_damping(const std::string& where, const rod::ForkSettings& fork) {
  const rod::PerDof& ratio = fork.damping_ratio;
  if (std::find(damping_laws.begin(), damping_laws.end(), fork.damping_law) == damping_laws.end()) {
    validation::refuse(where, "damping law", fork.damping_law, "one of " + validation::join(damping_laws));
  }
  if (fork.damping_law != "modal" || ratio == rod::PerDof{ratio.stretch, ratio.stretch, ratio.stretch}) return;
  validation::refuse(where, "damping ratios",
                     text_of(ratio.stretch) + ", " + text_of(ratio.bend) + ", " + text_of(ratio.torsion),
                     "the same for stretch, bend and torsion where the damping law is modal");
}

validation::NumberRule allowed_tolerance() {
  return validation::between(0.0, dynamics::StepControl::largest_tolerance);
}

std::vector<SettingDescription> setting_descriptions() {
  std::vector<SettingDescription> descriptions;
  for (const Field& field : fields()) descriptions.push_back(field.description);
  return descriptions;
}

void apply_settings(const YAML::Node& values, const std::string& where, SimulationSettings& settings) {
  if (!values.IsMap()) validation::refuse(where, "(top level)", "what is given", "a map of settings");
  std::vector<KeyAndValue> flat;
  flatten(values, where, "", flat);
  SimulationSettings changed = settings;
  std::set<std::string> seen;
  for (const auto& [key, node] : flat) {
    const std::string line = node.Mark().is_null() ? "" : ":" + std::to_string(node.Mark().line + 1);
    if (!seen.insert(key).second) validation::refuse(where + line, key, "a second value", "given once");
    find_field(key, where + line).read(node, where, changed);
  }
  settings = changed;
}

}  // namespace spring_workbench::simulation
