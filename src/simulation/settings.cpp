#include "spring_workbench/simulation/settings.h"

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>
#include <utility>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/dynamics/step_control.h"
#include "spring_workbench/validation/one_line.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::simulation {
namespace {

using S = SimulationSettings;
using validation::between;
using validation::NumberRule;

/// Where a setting's value is kept.
template <typename T>
using Member = std::function<T&(S&)>;
template <typename A, typename T>
auto at(A S::*group, T A::*field) {
  return Member<T>([=](S& s) -> T& { return s.*group.*field; });
}
template <typename A, typename B, typename T>
auto at(A S::*group, B A::*part, T B::*field) {
  return Member<T>([=](S& s) -> T& { return s.*group.*part.*field; });
}

/// One row of the table: who reads a file, a parameter or a command line, and who checks settings made in C++, ask the
/// same rule.
struct Field {
  SettingDescription description;
  std::function<void(const YAML::Node&, const std::string& where, S&)> read;
  std::function<void(const std::string& where, S&)> check;
};

std::string text_of(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

Field number(const std::string& key, const std::string& unit, const NumberRule& rule, const std::string& meaning,
             const Member<double>& member) {
  S defaults;
  const double value = member(defaults);
  return {{key, "double", unit, rule.text(), std::isinf(value) ? ".inf" : text_of(value), meaning},
          [=](const auto& node, const auto& where, S& s) { member(s) = config::read_number(node, where, key, rule); },
          [=](const auto& where, S& s) { validation::check_number(where, key, member(s), rule); }};
}

/// A number without a default of its own: `absent` says what is used then.
Field number(const std::string& key, const std::string& unit, const NumberRule& rule, const std::string& absent,
             const std::string& meaning, const Member<std::optional<double>>& member) {
  return {{key, "double", unit, rule.text(), absent, meaning},
          [=](const auto& node, const auto& where, S& s) { member(s) = config::read_number(node, where, key, rule); },
          [=](const auto& where, S& s) {
            if (member(s)) validation::check_number(where, key, *member(s), rule);
          }};
}

Field integer(const std::string& key, int min, int max, const std::string& meaning, const Member<int>& member) {
  S defaults;
  const std::string allowed = "an integer in [" + std::to_string(min) + ", " + std::to_string(max) + "]";
  return {
      {key, "int", "–", allowed, std::to_string(member(defaults)), meaning},
      [=](const auto& node, const auto& where, S& s) { member(s) = config::read_integer(node, where, key, min, max); },
      [=](const auto& where, S& s) {
        const int value = member(s);
        if (value < min || value > max) validation::refuse(where, key, std::to_string(value), allowed);
      }};
}

Field flag(const std::string& key, const std::string& meaning, const Member<bool>& member) {
  S defaults;
  return {{key, "bool", "–", "true or false", member(defaults) ? "true" : "false", meaning},
          [=](const auto& node, const auto& where, S& s) { member(s) = config::read_bool(node, where, key); },
          [](const auto&, S&) {}};
}

template <typename E>
void check(E value, const std::string& where, const std::string& key) {
  const auto& names = validation::names<E>();
  if (static_cast<std::size_t>(value) < names.size()) return;
  validation::refuse(where, key, "no value of its enum", "one of " + validation::join(names));
}

template <typename E>
std::string allowed() {
  return "one of " + validation::join(validation::names<E>());
}

template <typename E>
Field choice(const std::string& key, const std::string& meaning, const Member<E>& member) {
  S defaults;
  return {{key, "string", "–", allowed<E>(), validation::name_of(member(defaults)), meaning},
          [=](const auto& node, const auto& where, S& s) { member(s) = config::read_named<E>(node, where, key); },
          [=](const auto& where, S& s) { check(member(s), where, key); }};
}

template <typename E>
Field choice(const std::string& key, const std::string& absent, const std::string& meaning,
             const Member<std::optional<E>>& member) {
  return {{key, "string", "–", allowed<E>(), absent, meaning},
          [=](const auto& node, const auto& where, S& s) { member(s) = config::read_named<E>(node, where, key); },
          [=](const auto& where, S& s) {
            if (member(s)) check(*member(s), where, key);
          }};
}

NumberRule positive_or_infinite() {
  NumberRule rule = validation::positive();
  rule.infinity_allowed = true;
  return rule;
}

std::vector<Field> scene_fields() {
  const std::string as_scene = "as the scene says";
  const auto direct = [](auto S::*field) {
    using T = std::remove_reference_t<decltype(std::declval<S&>().*field)>;
    return Member<T>([=](S& s) -> T& { return s.*field; });
  };
  return {
      choice("tool", as_scene, "the tool in the hand", direct(&S::tool)),
      choice("contact", as_scene,
             "none: nothing is felt; stop: the held object stops at everything else and slides on; dynamic: it pushes, "
             "lifts and carries what it touches",
             direct(&S::contact)),
      number("gravity", "m/s²", between(0.0, 1e3), as_scene, "along −z of world", direct(&S::gravity)),
      number("force_scale", "–", between(1e-9, 1e9), as_scene, "virtual per real unit of force",
             direct(&S::force_scale)),
  };
}

std::vector<Field> dynamics_fields() {
  using D = dynamics::DynamicsSettings;
  return {
      choice("integrator", "how the fork and the held object are stepped", at(&S::dynamics, &D::integrator)),
      number("step", "s", between(1e-6, 1.0), "the largest step; a step also ends at every sample of the motion",
             at(&S::dynamics, &D::step)),
      number("tolerance", "m", between(0.0, dynamics::StepControl::largest_tolerance),
             "0: fixed steps; else steps are made short enough for the run's error to stay near this",
             at(&S::dynamics, &D::tolerance)),
      choice("inertia", "exact: the object's own; point_mass: the paper's I = r² m", at(&S::dynamics, &D::inertia)),
  };
}

std::vector<Field> fork_fields() {
  using F = rod::ForkSettings;
  using P = rod::PerDof;
  const NumberRule stiffness = between(0.0, 1e16), ratio = between(0.0, 10.0), coefficient = between(0.0, 1e12);
  const auto dof = [](bool rod::ForkDofs::*field) { return at(&S::fork, &F::dofs, field); };
  return {
      choice("shape", "the fork's shape model: how its curvature may vary along it", at(&S::fork, &F::shape)),
      number("fork.length", "m", between(1e-4, 1e3), "rest length", at(&S::fork, &F::length)),
      number("fork.stiffness.stretch", "N/m", stiffness, "axial force per extension",
             at(&S::fork, &F::stiffness, &P::stretch)),
      number("fork.stiffness.bend", "N/m", stiffness, "transverse tip force per tip deflection",
             at(&S::fork, &F::stiffness, &P::bend)),
      number("fork.stiffness.torsion", "N·m/rad", stiffness, "axial moment per twist angle",
             at(&S::fork, &F::stiffness, &P::torsion)),
      number("fork.stiffness.slope", "N·m/rad", between(1e-12, 1e16), "k_bend L² / 3, as of a rod",
             "of the shape bushing: transverse moment per slope of the tip", at(&S::fork, &F::slope_stiffness)),
      number("fork.damping.stretch", "–", ratio, "damping ratio of stretching; 1 is critical",
             at(&S::fork, &F::damping_ratio, &P::stretch)),
      number("fork.damping.bend", "–", ratio, "damping ratio of bending; 1 is critical",
             at(&S::fork, &F::damping_ratio, &P::bend)),
      number("fork.damping.torsion", "–", ratio, "damping ratio of twisting; 1 is critical",
             at(&S::fork, &F::damping_ratio, &P::torsion)),
      number("fork.damping_coefficient.stretch", "N·s/m", coefficient, "axial force per speed of extension",
             at(&S::fork, &F::damping_coefficient, &P::stretch)),
      number("fork.damping_coefficient.bend", "N·s/m", coefficient, "transverse force per speed of deflection",
             at(&S::fork, &F::damping_coefficient, &P::bend)),
      number("fork.damping_coefficient.torsion", "N·m·s/rad", coefficient, "axial moment per twist rate",
             at(&S::fork, &F::damping_coefficient, &P::torsion)),
      choice(
          "fork.damping_law",
          "per_dof: Kelvin–Voigt, the ratio that of each degree of freedom alone; modal: every mode of the held object "
          "has the ratio, which must be the same for all; coefficients: those of fork.damping_coefficient",
          at(&S::fork, &F::damping_law)),
      flag("fork.dofs.stretch", "the fork stretches; false: rigid", dof(&rod::ForkDofs::stretch)),
      flag("fork.dofs.bend", "the fork bends; false: rigid", dof(&rod::ForkDofs::bend)),
      flag("fork.dofs.torsion", "the fork twists; false: rigid", dof(&rod::ForkDofs::torsion)),
      number("fork.switch_off_time", "s", between(1e-6, 1e3),
             "time constant on which a degree of freedom that is switched off while strained goes back to zero strain",
             at(&S::fork, &F::switch_off_time)),
  };
}

std::vector<Field> grasp_fields() {
  using G = tools::GraspSettings;
  using L = tools::LimitSettings;
  const Member<std::string> object = at(&S::grasp, &G::object);
  const Member<std::optional<RigidTransform>> tip = at(&S::grasp, &G::X_OE);
  return {
      number("limit.force", "N", positive_or_infinite(),
             "what would take a larger force at the tip than this is let go", at(&S::limit, &L::force)),
      number("limit.moment", "N·m", positive_or_infinite(),
             "what would take a larger moment at the tip than this is let go", at(&S::limit, &L::moment)),
      choice(
          "calibrate",
          "object: size, springs and dampers of the tool from the object and its grasp, on every grasp; none: as set",
          at(&S::grasp, &G::calibrate)),
      {{"grasp.object", "string", "–", "the name of a movable object of the scene", "none: grasped by button",
        "this object is held from the first sample to the last"},
       [=](const auto& node, const auto& where, S& s) { object(s) = config::read_string(node, where, "grasp.object"); },
       [](const auto&, S&) {}},  // which objects there are, the scene knows
      {{"grasp.tip_in_object", "double list", "m, –", "x y z qx qy qz qw, the quaternion not zero",
        "where the tip is when it grasps", "the tip frame in the object's centre-of-mass frame"},
       [=](const auto& node, const auto& where, S& s) {
         tip(s) = config::read_pose(node, where, "grasp.tip_in_object");
       },
       [=](const auto& where, S& s) {
         if (!tip(s) || tip(s)->matrix().allFinite()) return;
         validation::refuse(where, "grasp.tip_in_object", "a pose that is not finite", "finite");
       }},
      flag("start.follow", "move the object so that the grasp fits the first pose of the handle",
           at(&S::grasp, &G::start_follow)),
      choice("release", "a released object keeps its velocity (thrown) or is set to rest (dropped)",
             at(&S::grasp, &G::release)),
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
const std::vector<Field>& fields() {
  static const std::vector<Field> all = [] {
    std::vector<Field> rows;
    for (auto group : {scene_fields, dynamics_fields, fork_fields, grasp_fields, other_fields}) {
      for (Field& field : group()) rows.push_back(std::move(field));
    }
    return rows;
  }();
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
  std::vector<std::string> known;
  for (const Field& field : fields()) known.push_back(field.description.key);
  throw validation::InputError(
      validation::one_line(where + ": " + key + ": " + validation::unknown_key(key, validation::join(known))));
}

/// Values that each are allowed, and do not go with each other.
void check_together(const S& settings, const std::string& where) {
  const rod::ForkSettings& fork = settings.fork;
  const rod::PerDof& ratio = fork.damping_ratio;
  const bool one_ratio = ratio == rod::PerDof{ratio.stretch, ratio.stretch, ratio.stretch};
  if (fork.damping_law == rod::DampingLaw::modal && !one_ratio) {
    validation::refuse(where, "fork.damping",
                       text_of(ratio.stretch) + ", " + text_of(ratio.bend) + ", " + text_of(ratio.torsion),
                       "the same for stretch, bend and torsion where the damping law is modal");
  }
  if (settings.grasp.X_OE && !settings.grasp.start_follow) {
    validation::refuse(where, "grasp.tip_in_object", "(a pose)",
                       "used with start.follow: true, so that the object can move to it");
  }
}

}  // namespace

void validate(const SimulationSettings& settings, const std::string& where) {
  S copy = settings;  // its fields are found by reference
  for (const Field& field : fields()) field.check(where, copy);
  check_together(settings, where);
}

bool ForkChange::changes_springs() const {
  return stretch_stiffness || bend_stiffness || torsion_stiffness || damping_ratio || damping_coefficient ||
         damping_law;
}

rod::ForkSettings ForkChange::applied_to(rod::ForkSettings fork) const {
  fork.dofs = dofs.value_or(fork.dofs);
  fork.stiffness.stretch = stretch_stiffness.value_or(fork.stiffness.stretch);
  fork.stiffness.bend = bend_stiffness.value_or(fork.stiffness.bend);
  fork.stiffness.torsion = torsion_stiffness.value_or(fork.stiffness.torsion);
  fork.damping_ratio = damping_ratio.value_or(fork.damping_ratio);
  fork.damping_coefficient = damping_coefficient.value_or(fork.damping_coefficient);
  fork.damping_law = damping_law.value_or(fork.damping_law);
  return fork;
}

ForkChange change_to(const rod::ForkSettings& fork) {
  ForkChange change;
  change.dofs = fork.dofs;
  change.stretch_stiffness = fork.stiffness.stretch;
  change.bend_stiffness = fork.stiffness.bend;
  change.torsion_stiffness = fork.stiffness.torsion;
  change.damping_ratio = fork.damping_ratio;
  change.damping_coefficient = fork.damping_coefficient;
  change.damping_law = fork.damping_law;
  return change;
}

dynamics::DynamicsSettings DynamicsChange::applied_to(dynamics::DynamicsSettings dynamics) const {
  dynamics.integrator = integrator.value_or(dynamics.integrator);
  dynamics.step = step.value_or(dynamics.step);
  dynamics.tolerance = tolerance.value_or(dynamics.tolerance);
  return dynamics;
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
