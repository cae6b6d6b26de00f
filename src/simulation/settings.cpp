#include "spring_workbench/simulation/settings.h"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/scene/number_rules.h"
#include "spring_workbench/stepping/step_control.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::simulation {
namespace {

using S = SimulationSettings;
using validation::between;
using validation::NumberRule;

/// One key of the settings of one table, with the rule that checks its values, wherever they come from, without texts.
struct Field {
  struct About {
    const char *key, *type, *unit, *meaning;
  } about;
  std::function<std::string()> allowed, set;
  std::function<void(const YAML::Node&, const std::string& where)> read;
  std::function<void(const std::string& where)> check;
};

template <typename T>
const T* given(const T& value) {
  return &value;
}
template <typename T>
const T* given(const std::optional<T>& value) {
  return value ? &*value : nullptr;
}

std::string text_of(double value) { return std::isinf(value) ? ".inf" : validation::number_text(value); }

/// `value`: a number or an optional number; `absent` describes what is used if it is absent.
template <typename T>
Field number(const char* key, const char* unit, const NumberRule& rule, const char* meaning, T& value,
             const char* absent = "") {
  const NumberRule in_unit = rule.in(unit);
  return {{key, "double", unit, meaning},
          [=] { return rule.in("").text(); },
          [=, &value] { return given(value) ? text_of(*given(value)) : absent; },
          [=, &value](const auto& node, const auto& where) { value = config::read_number(node, where, key, in_unit); },
          [=, &value](const auto& where) {
            if (given(value)) validation::check_number(where, key, *given(value), in_unit);
          }};
}

Field integer(const char* key, int min, int max, const char* meaning, int& value) {
  const auto allowed = [=] { return "an integer between " + std::to_string(min) + " and " + std::to_string(max); };
  return {
      {key, "int", "–", meaning},
      allowed,
      [&value] { return std::to_string(value); },
      [=, &value](const auto& node, const auto& where) { value = config::read_integer(node, where, key, min, max); },
      [=, &value](const auto& where) {
        if (value < min || value > max) validation::refuse(where, key, std::to_string(value), allowed());
      }};
}

Field flag(const char* key, const char* meaning, bool& value) {
  return {{key, "bool", "–", meaning},
          [] { return "true or false"; },
          [&value] { return value ? "true" : "false"; },
          [=, &value](const auto& node, const auto& where) { value = config::read_bool(node, where, key); },
          [](const auto&) {}};
}

/// `value`: an enum or an optional enum; see number().
template <typename T>
Field choice(const char* key, const char* meaning, T& value, const char* absent = "") {
  using E = std::decay_t<decltype(*given(value))>;
  const auto allowed = [] { return "one of " + validation::join(validation::names<E>()); };
  return {{key, "string", "–", meaning},
          allowed,
          [=, &value] { return given(value) ? validation::name_of(*given(value)) : absent; },
          [=, &value](const auto& node, const auto& where) { value = config::read_named<E>(node, where, key); },
          [=, &value](const auto& where) {
            const auto known = validation::names<E>().size();
            if (given(value) && static_cast<std::size_t>(*given(value)) >= known)
              validation::refuse(where, key, allowed());
          }};
}

std::vector<Field> scene_fields(S& s) {
  const char* as_scene = "as the scene says";
  return {
      choice("tool", "the tool in the hand", s.tool, as_scene),
      choice(
          "contact",
          "none: no contact; stop: the held object stops at everything else and slides along it; dynamic: it pushes, "
          "lifts and carries what it touches",
          s.contact, as_scene),
      number("gravity", "m/s²", scene::gravity_rule(), "along −z of world", s.gravity, as_scene),
      flag("massless", "no object has mass: each follows the tip, and stays where it is released", s.massless),
      number("force_scale", "–", scene::force_scale_rule(), "ratio of virtual to real force", s.force_scale, as_scene),
      integer("styluses", 1, 255, "number of styluses, each with its tool; silent ones do nothing", s.styluses),
      number("hand.scale", "–", between(1e-3, 1e3),
             "metres in the world per metre of the hand, from the origin; rotations are not scaled", s.hand_scale),
      number("hand.time_scale", "–", between(1e-3, 1e3),
             "seconds in the world per second of the hand; below 1 the world runs in slow motion", s.hand_time_scale),
      integer("clutch.button", 2, 63, "the stylus button that lets the hand move without its tool", s.clutch_button),
  };
}

std::vector<Field> dynamics_fields(dynamics::DynamicsSettings& d) {
  return {
      choice("integrator",
             "the method that integrates the motion; paper: while one fork holds the object, otherwise exponential",
             d.integrator),
      number("step", "s", between(1e-6, 1.0), "the largest step; a step also ends at every sample", d.step),
      number("tolerance", "m", between(0.0, stepping::StepControl::largest_tolerance),
             "0: fixed steps; otherwise steps short enough to keep the error of the run near this value", d.tolerance),
      flag("error_bound", "propagate the error of the run and report a bound on it", d.error_bound),
      choice("inertia", "exact: the object's own; point_mass: the paper's I = r² m (not with tool spring)", d.inertia),
  };
}

std::vector<Field> fork_fields(rod::ForkSettings& f) {
  const NumberRule stiffness = between(0.0, 1e16), ratio = between(0.0, 10.0), coefficient = between(0.0, 1e12);
  rod::PerDof &k = f.stiffness, &zeta = f.damping_ratio, &c = f.damping_coefficient;
  return {
      choice("shape", "the fork's shape model: how its curvature varies along it", f.shape),
      number("fork.length", "m", between(1e-4, 1e3), "rest length", f.length),
      number("fork.stiffness.stretch", "N/m", stiffness, "axial force per unit extension", k.stretch),
      number("fork.stiffness.bend", "N/m", stiffness, "transverse tip force per unit deflection of the tip", k.bend),
      number("fork.stiffness.torsion", "N·m/rad", stiffness, "axial moment per unit twist angle", k.torsion),
      number("fork.stiffness.slope", "N·m/rad", between(1e-12, 1e16),
             "for the shape bushing only: transverse moment per unit slope of the tip", f.slope_stiffness,
             "k_bend L² / 3, as for a rod"),
      number("fork.damping.stretch", "–", ratio, "damping ratio of stretching; 1 is critical", zeta.stretch),
      number("fork.damping.bend", "–", ratio, "damping ratio of bending; 1 is critical", zeta.bend),
      number("fork.damping.torsion", "–", ratio, "damping ratio of twisting; 1 is critical", zeta.torsion),
      number("fork.damping_coefficient.stretch", "N·s/m", coefficient, "force per unit extension rate", c.stretch),
      number("fork.damping_coefficient.bend", "N·s/m", coefficient, "force per unit deflection rate", c.bend),
      number("fork.damping_coefficient.torsion", "N·m·s/rad", coefficient, "axial moment per unit twist rate",
             c.torsion),
      choice("fork.damping_law",
             "per_dof: Kelvin–Voigt, each ratio is that of its degree of freedom alone; modal: all modes of the held "
             "object have the same ratio, so the three ratios must be equal; coefficients: the values of "
             "fork.damping_coefficient",
             f.damping_law),
      flag("fork.dofs.stretch", "the fork stretches; false: rigid", f.dofs.stretch),
      flag("fork.dofs.bend", "the fork bends; false: rigid", f.dofs.bend),
      flag("fork.dofs.torsion", "the fork twists; false: rigid", f.dofs.torsion),
      number("fork.switch_off_time", "s", between(1e-6, 1e3),
             "T: a degree of freedom that is switched off while strained returns to zero, critically damped; from rest "
             "it falls as (1 + t/T) exp(−t/T), to 1 % in 6.6 T",
             f.switch_off_time),
  };
}

std::vector<Field> calibration_fields(tools::GraspSettings& s) {
  tools::ObjectGoal& of_object = s.object_goal;
  tools::WorldGoal& of_world = s.world_goal;
  return {
      choice("calibrate",
             "world: the springs of the tool are chosen once for all objects of the scene, so that it stretches, bends "
             "and twists in proportion to the load; object: size, springs and dampers are chosen for each object when "
             "it is grasped; none: they stay as set",
             s.calibrate),
      number("calibration.object.sag", "–", between(1e-3, 0.6),
             "fraction of the fork's length by which the object's weight extends and deflects it", of_object.sag),
      number("calibration.object.twist", "rad", between(1e-3, 1.5),
             "angle by which the fork twists when it holds an object of the density of water one radius of gyration "
             "off its centre",
             of_object.twist),
      number("calibration.world.stretch", "–", between(1e-3, 3.0),
             "fraction of the fork's length by which the weight of the heaviest object extends it", of_world.stretch),
      number("calibration.world.bend", "–", between(1e-3, 0.6),
             "fraction of the fork's length by which that weight, held level at its centre, deflects the tip",
             of_world.bend),
      number("calibration.world.twist", "rad", between(1e-3, 1.0),
             "twist under that weight at a lever of the object's radius of gyration", of_world.twist),
      number("calibration.world.heaviest", "kg", between(1e-6, 1e6), "the mass to calibrate for", of_world.heaviest,
             "the scene's heaviest object"),
  };
}

std::vector<Field> grasp_fields(S& s) {
  std::string& object = s.grasp.object;
  std::optional<RigidTransform>& tip = s.grasp.X_OE;
  return {
      number("limit.force", "N", validation::positive_or_infinite(),
             "the largest force that a tool with springs exerts at its tip", s.limit.force),
      number("limit.moment", "N·m", validation::positive_or_infinite(),
             "the largest moment that a tool with springs exerts at its tip", s.limit.moment),
      choice("limit.action",
             "what happens when holding an object would need more than limit.force or limit.moment: let_go: the object "
             "is released; slip: the tool keeps pulling with the limit while it slips in the hand",
             s.limit.action),
      {{"grasp.object", "string", "–", "this object is held from the first sample on; the grasp button does nothing"},
       [] { return "the name of a movable object of the scene"; },
       [] { return "none: grasped by button"; },
       [&](const auto& node, const auto& where) {
         object = config::read_string(node, where, "grasp.object");
         s.grasp.object_location = config::place(node, where);
       },
       [](const auto&) {}},  // checked against the scene later
      {{"grasp.tip_in_object", "double list", "m, –", "the tip frame in the object's centre-of-mass frame"},
       [] { return "x y z qx qy qz qw, with a nonzero quaternion"; },
       [] { return "the pose of the tip at the grasp"; },
       [&](const auto& node, const auto& where) {
         tip = config::read_pose(node, where, "grasp.tip_in_object");
         s.grasp.tip_location = config::place(node, where);
       },
       [&](const auto& where) {
         if (tip && !tip->matrix().allFinite()) validation::refuse(where, "grasp.tip_in_object", "a finite pose");
       }},
      flag("start.follow", "move the object so that the grasp fits the first pose of the handle", s.grasp.start_follow),
      choice("release", "a released object keeps its velocity (thrown) or is set to rest (dropped)", s.grasp.release),
      number("dropout_after", "s", validation::positive_or_infinite(),
             "if the gap between two samples is longer, the handle is at rest until the next sample", s.dropout_after),
      number("external_wrench_timeout", "s", between(1e-3, 10.0),
             "how long an external wrench acts if no newer one arrives; it is zero after that",
             s.external_wrench_timeout),
      integer("impact_bisections", 0, 30,
              "number of bisections that find the end of a step in which contact begins (section 5 of the paper); 0: "
              "the time of impact is computed instead",
              s.impact_bisections),
  };
}

/// The table of all keys.
std::vector<Field> fields(S& s) {
  std::vector<Field> all;
  for (auto& group : {scene_fields(s), dynamics_fields(s.dynamics), fork_fields(s.fork), calibration_fields(s.grasp),
                      grasp_fields(s)}) {
    all.insert(all.end(), group.begin(), group.end());
  }
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

const Field& find_field(const std::vector<Field>& table, const std::string& key, const std::string& where) {
  const auto is = [&](const Field& field) { return field.about.key == key; };
  const auto found = std::find_if(table.begin(), table.end(), is);
  if (found != table.end()) return *found;
  std::vector<std::string> known;
  for (const Field& field : table) known.push_back(field.about.key);
  validation::refuse_because(where, key, validation::unknown_key(key, known));
}

/// Refuses combinations of values that are each valid but incompatible.
void check_together(const S& settings, const std::string& where) {
  const rod::ForkSettings& fork = settings.fork;
  const rod::PerDof& ratio = fork.damping_ratio;
  if (fork.damping_law == rod::DampingLaw::modal && !ratio.uniform()) {
    validation::refuse(
        where, "fork.damping", text_of(ratio.stretch) + ", " + text_of(ratio.bend) + ", " + text_of(ratio.torsion),
        "equal ratios of stretch, bend and torsion if the damping law is modal (the law per_dof takes three)");
  }
  if (settings.grasp.X_OE && !settings.grasp.start_follow) {
    validation::refuse_because(settings.grasp.tip_location, "grasp.tip_in_object",
                               "needs start.follow: true, so that the object can move to it");
  }
}

}  // namespace

void validate(const SimulationSettings& settings, const std::string& where) {
  S copy = settings;  // the fields refer to it
  for (const Field& field : fields(copy)) field.check(where);
  check_together(settings, where);
}

dynamics::DynamicsSettings DynamicsChange::applied_to(dynamics::DynamicsSettings dynamics) const {
  dynamics.integrator = integrator.value_or(dynamics.integrator);
  dynamics.step = step.value_or(dynamics.step);
  dynamics.tolerance = tolerance.value_or(dynamics.tolerance);
  return dynamics;
}

bool ObjectEdit::operator==(const ObjectEdit& other) const {
  math::StateArchive a, b;
  ObjectEdit(*this).archive(a);
  ObjectEdit(other).archive(b);
  return std::move(a).words() == std::move(b).words();
}

void validate(const ObjectEdit& edit) {
  if (edit.action > ObjectEdit::Action::friction)
    validation::refuse("", "action", std::to_string(static_cast<int>(edit.action)),
                       "one of " + validation::join(validation::names<ObjectEdit::Action>()));
  if (edit.X_WL && !edit.X_WL->matrix().allFinite()) validation::refuse("", "pose", "a finite pose");
  if (edit.action == ObjectEdit::Action::move && !edit.X_WL)
    validation::refuse("", "pose", "a pose to move to (quaternion not zero)");
  validation::check_number("", "mass", edit.mass, scene::mass_rule());
  validation::check_number("", "friction", edit.friction, scene::friction_rule());
}

std::vector<SettingDescription> setting_descriptions() {
  S defaults;
  std::vector<SettingDescription> descriptions;
  for (const Field& f : fields(defaults)) {
    descriptions.push_back({f.about.key, f.about.type, f.about.unit, f.allowed(), f.set(), f.about.meaning});
  }
  return descriptions;
}

void apply_settings(const YAML::Node& values, const std::string& where, SimulationSettings& settings) {
  if (!values.IsMap()) validation::refuse(config::place(values, where), "top level", "a map of settings");
  std::vector<KeyAndValue> flat;
  flatten(values, where, "", flat);
  SimulationSettings changed = settings;
  const std::vector<Field> table = fields(changed);
  std::set<std::string> seen;
  for (const auto& [key, node] : flat) {
    const std::string place = config::place(node, where);
    if (!seen.insert(key).second) validation::refuse_because(place, key, "given twice");
    find_field(table, key, place).read(node, where);
  }
  settings = changed;
}

}  // namespace spring_workbench::simulation
