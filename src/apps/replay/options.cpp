#include "options.h"

#include <filesystem>
#include <regex>
#include <sstream>

#include "spring_workbench/config/command_line.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::replay {
using config::command_line;
namespace {

/// Notes the names of all keys of `values`, written `{a: {b: 1}}` or `a.b: 1`.
void note_keys(const YAML::Node& values, const std::string& where, const std::string& prefix, Options& options) {
  for (const auto& entry : values) {
    const std::string key = prefix + (entry.first.IsScalar() ? entry.first.Scalar() : "");
    if (entry.second.IsMap()) {
      note_keys(entry.second, where, key + ".", options);
    } else {
      options.given.emplace_back(config::place(entry.second, where), key);
    }
  }
}

/// Applies `values`: the key `rate` here, all others to the settings of the simulation.
void apply(const YAML::Node& values, const std::string& where, Options& options) {
  if (!values.IsMap()) validation::refuse(config::place(values, where), "top level", "a map of settings");
  YAML::Node settings(YAML::NodeType::Map);
  for (const auto& entry : values) {
    if (entry.first.IsScalar() && entry.first.Scalar() == "rate") {
      options.rate = config::read_number(entry.second, where, "rate", validation::between(1e-3, 1e6).in("Hz"));
    } else {
      settings.force_insert(entry.first, entry.second);
    }
  }
  hand_input::take_input_settings(settings, where, options.input);
  simulation::apply_settings(settings, where, options.settings);
  note_keys(values, where, "", options);
}

void apply_assignment(const std::string& assignment, Options& options) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) validation::refuse(command_line, "--set", assignment, "key=value");
  YAML::Node values(YAML::NodeType::Map);
  values[assignment.substr(0, equals)] = assignment.substr(equals + 1);
  apply(values, command_line, options);
}

config::CommandOption once(const std::string& name, std::string& field) {
  return {name, [=, &field](const std::string& value) {
            if (!field.empty())
              throw validation::InputError(std::string(command_line) + ": --" + name + ": given twice");
            if (value.empty()) validation::refuse(command_line, "--" + name, value, "a path or a name");
            field = value;
          }};
}

void add_motion(const std::string& path, std::vector<std::string>& motions) {
  if (path.empty()) validation::refuse(command_line, "--motion", path, "a path");
  motions.push_back(path);
}

void check_complete(const Options& options) {
  if (options.scene.empty()) validation::refuse_missing(command_line, "--scene", "path of a URDF scene");
  if (options.motions.empty() == options.bag.empty()) {
    if (options.bag.empty()) validation::refuse_missing(command_line, "--motion or --bag", "path of the recorded hand");
    throw validation::InputError(std::string(command_line) + ": --motion, --bag: cannot be given together");
  }
  if (options.bag.empty() && !(options.parent + options.child).empty())
    throw validation::InputError(std::string(command_line) +
                                 ": --parent, --child: can only be given together with --bag");
  if (options.bag.empty() && options.hand_only)
    throw validation::InputError(std::string(command_line) + ": --hand-only: can only be given together with --bag");
  if (options.out.empty()) validation::refuse_missing(command_line, "--out", "path of the CSV file to write");
}

void check_not_read(const Options& options, const std::string& settings) {
  std::vector<std::string> read = options.motions;
  read.insert(read.end(), {options.scene, options.bag, settings});
  for (const std::string& input : read) {
    for (const std::string& output : {options.out, fork_path(options.out)}) {
      std::error_code there_is_none;
      if (std::filesystem::equivalent(input, output, there_is_none))
        throw validation::InputError(validation::prefix(command_line, "--out") + output +
                                     " is an input of this run and would be overwritten");
    }
  }
}

const char* const usage_text =
    R"(Runs the simulation on a recorded hand, without a ROS master or clock; equal input gives bit-identical CSV.

replay --scene SCENE.urdf (--motion FILE [--motion FILE ...] | --bag FILE.bag [--parent FRAME] [--child FRAME]
       [--hand-only]) [--settings FILE.yaml] [--set key=value ...] --out RUN.csv

  --scene     a scene: path or package:// URI of a URDF; a YAML file of the same name next to it is read, too
  --motion    a hand: lines of `t x y z qx qy qz qw [button]` (t in s; x, y, z in m; button 0 or 1), or a script
              (*.yaml) of waypoints; the first sample of each hand is at t = 0
  --bag       the hands from a bag: its transforms --parent -> --child (default workbench -> stylus), placed by
              /tf_static, and buttons 0 (grasp), 1 (next tool) and clutch.button of stylus/joy; further hands
              from CHILD_2 (stylus_2) and stylus_2/joy, CHILD_3, ..., all that the bag has. If it has ~accepted and
              ~changes of manipulation, the run since its last start is repeated, with a line for each committed time
  --hand-only plays only the poses and buttons of such a bag, with the settings given
  --settings  a YAML file of the keys below
  --set       one key; may be given several times; takes precedence over --settings
  --out       writes or replaces RUN.csv and RUN.fork.csv; nothing is written if anything fails

Example, in the root of the repository: the demo's hand, with a stiffer fork
  replay --scene scenes/mini_world.urdf --motion config/mini_world_demo.yaml --set fork.stiffness.bend=900 --out run.csv

)";

const char* const output_text =
    R"(Times are in s, with --bag from the first sample of any hand. Without a button in the motion, nothing is held
unless grasp.object names an object, which the first hand then holds; the buttons are then ignored.

RUN.csv, a line per output time and movable object [s, -, m, -, m/s, rad/s], of its centre of mass in world:
  t,object,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz
RUN.fork.csv, a line per output time and hand:
  t,fork,tool,held                          [s], the hand's fork (fork, fork_2, ...), its tool, the object held
  stretch,bend_x,bend_y,torsion             [m, m, m, rad] deformation of the fork, measured at its tip
  handle_x,...,handle_qw                    the handle in world
  proxy_x,...,proxy_qw                      the proxy handle (differs from the handle if the object cannot follow)
  tip_x,...,tip_qw                          the tip in world
  tip_fx,tip_fy,tip_fz,tip_mx,tip_my,tip_mz          [N, N*m] on the object, at the tip, world axes
  handle_fx,...,handle_mz                            [N, N*m] on the hand, handle axes
  elastic_energy,kinetic_energy             [J] of the fork; of the held object
  stretching_force,bending_force,force_angle         [N, N, rad] of the force on the fork, along and across its axis
  weight,weight_mean,weight_uncertainty     [vkg] the tool as a scale: now, over the last second, standard deviation
  torque,torque_mean,torque_uncertainty     [N*m] the tool as a torque wrench
  material_stiffness,material_stiffness_uncertainty  [N/m] what spring_probe reads; inf: rigid; 0: no reading
  error_bound                               [m] of the position; inf: none

The last line on standard output is one JSON object (null: no number):
  steps, simulated_time, outputs            [-, s, -] what was simulated and written
  wall_time, time_per_step                  [s, s] what it took
  samples, samples_rejected, rejected       of the hands; rejected by input.*; the same by reason
  dropouts, losses, reacquisitions          gaps over dropout_after, and over input.loss_timeout; returns of the hand
  position_error, angle_error               [m, rad] largest estimate of a step's local error
  local_error_bound                         [m] largest estimated bound on it
  error_bound, angle_error_bound            [m, rad] largest estimated bound on the error of the run
  integrations_without_bound                integrations without such an estimate
  energy_balance                            [J] added by integration beyond hand, gravity, damping and contact
  stiffest_omega_dt                         largest product of the stiffest mode's angular frequency and the step
  contacts, collision_queries               pairs that began to touch, as seen at the output times; queries for contacts
  substeps                                  steps discarded and repeated as shorter ones
  stops                                     steps in which the fork reached the end of its range
  steps_fallback                            integrations by an L-stable rule, in place of the integrator
  steps_blocked, steps_unsolved             steps in which an object was blocked; in which a contact stayed unsolved
  steps_rejected                            steps without a usable result: the fork was rigid, or the object blocked
  time_lost                                 [s] during which an object did not follow its equation of motion
  changes                                   changes by services and panels that the bag has
  changes_replayed                          changes that were carried out again, not loaded from the bag
  changes_mismatched                        changes that led to another state than the recorded one
  state_hash, active, skipped               of the final state; the subsystems that ran; those that did not
Exit status: 0 done, with warnings on standard error; 1 failed; 2 bad arguments or input, with one line there.
)";

/// As ASCII, which every terminal shows.
std::string plain(std::string text) {
  static const std::pair<std::string, std::string> signs[] = {{"–", "-"}, {"−", "-"}, {"²", "^2"}, {"·", "*"}};
  for (const auto& [sign, ascii] : signs) {
    for (std::size_t at; (at = text.find(sign)) != text.npos;) text.replace(at, sign.size(), ascii);
  }
  return text;
}

/// Adds a paragraph in lines of at most 100 columns, all but the first indented.
void add_lines(const std::string& paragraph, std::ostream& text) {
  const std::string indent(6, ' ');
  std::istringstream words(paragraph);
  std::string line = "  ";
  for (std::string word; words >> word; line += word + " ") {
    if (line.size() + word.size() <= 100) continue;
    text << line.substr(0, line.size() - 1) << "\n";
    line = indent;
  }
  text << line.substr(0, line.size() - 1) << "\n";
}

void add_key(const std::string& key, const std::string& unit, const std::string& allowed, const std::string& standard,
             const std::string& meaning, std::ostream& text) {
  add_lines(key + (unit == "–" ? "" : " [" + plain(unit) + "]") + ": " + plain(meaning), text);
  text << "    ";
  add_lines(plain(allowed) + "; default: " + plain(standard), text);
}

}  // namespace

std::string fork_path(const std::string& path) {
  const std::string ending = ".csv";
  const bool has_ending =
      path.size() > ending.size() && path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
  return (has_ending ? path.substr(0, path.size() - ending.size()) : path) + ".fork.csv";
}

std::optional<Options> parse_options(int argc, char** argv) {
  Options options;
  std::string settings;
  std::vector<std::string> assignments;
  if (!config::read_command_line(argc, argv,
                                 {once("scene", options.scene),
                                  {"motion", [&](const std::string& path) { add_motion(path, options.motions); }},
                                  once("bag", options.bag),
                                  once("parent", options.parent),
                                  once("child", options.child),
                                  {"hand-only", [&](const std::string&) { options.hand_only = true; }, no_argument},
                                  once("settings", settings),
                                  {"set", [&](const std::string& assignment) { assignments.push_back(assignment); }},
                                  once("out", options.out)})) {
    return std::nullopt;
  }
  check_complete(options);
  check_not_read(options, settings);
  if (!options.parent.empty()) options.given.emplace_back(command_line, "--parent");
  if (!options.child.empty()) options.given.emplace_back(command_line, "--child");
  if (options.parent.empty()) options.parent = "workbench";
  if (options.child.empty()) options.child = "stylus";
  if (!settings.empty()) apply(config::load_yaml_file(settings), settings, options);
  for (const std::string& assignment : assignments) apply_assignment(assignment, options);
  return options;
}

void check_beside_journal(const Options& options) {
  static const std::regex determined(
      "--.*|rate|input\\..*|tool|styluses|integrator|step|tolerance|error_bound|"
      "fork\\.(dofs\\..*|stiffness\\.(stretch|bend|torsion)|damping.*)");
  for (const auto& [place, name] : options.given) {
    if (!std::regex_match(name, determined)) continue;
    throw validation::InputError(validation::prefix(place, name) + "cannot be given for " + options.bag +
                                 ", whose ~accepted and ~changes are repeated as recorded; add --hand-only to play " +
                                 "only its hands, with the settings given");
  }
}

std::string help_text() {
  std::ostringstream text;
  text << usage_text << output_text;
  text << "\nKeys, with [unit], what is allowed and the default:\n";
  add_key("rate", "Hz", "a number between 0.001 and 1e6", "50", "output times per second", text);
  const auto add = [&](const std::string& key, const auto& d) {
    add_key(key, d.unit, d.allowed, d.default_value, d.meaning, text);
  };
  for (const simulation::SettingDescription& d : simulation::setting_descriptions()) add(d.key, d);
  for (const hand_input::InputSettingDescription& d : hand_input::input_descriptions()) add("input." + d.key, d);
  return text.str();
}

}  // namespace spring_workbench::replay
