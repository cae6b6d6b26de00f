#include <map>
#include <variant>

#include "bindings.h"

namespace spring_workbench::python {

namespace py = pybind11;
using simulation::Simulation;
using simulation::SimulationSettings;

namespace {

/// The values of stretch, bend and torsion; None for all or one of them changes nothing. Throws InputError naming `key`
/// for anything else.
template <typename T>
rod::PerDofChange<T> per_dof(const py::object& values, const std::string& key) {
  if (values.is_none()) return {};
  try {
    const auto each = values.cast<std::array<std::optional<T>, 3>>();
    return {each[0], each[1], each[2]};
  } catch (const py::cast_error&) {
    const std::string kind = std::is_same_v<T, bool> ? "booleans" : "numbers";
    refuse(key, py::repr(values).cast<std::string>(), "three " + kind + " (or None), for stretch, bend and torsion");
  }
}

simulation::ChangeReport change(Simulation& of, const py::object& stiffness, const py::object& damping_ratio,
                                const py::object& dofs, const std::optional<std::string>& integrator,
                                std::optional<double> step, std::optional<double> tolerance,
                                const py::object& damping_coefficient, const std::optional<std::string>& damping_law,
                                const py::object& damping, std::optional<std::size_t> hand) {
  simulation::ForkChange fork;
  fork.stiffness = per_dof<double>(stiffness, "stiffness");
  fork.damping_ratio = per_dof<double>(damping_ratio, "damping_ratio");
  fork.damping_coefficient = per_dof<double>(damping_coefficient, "damping_coefficient");
  if (damping_law) fork.damping_law = value_of<rod::DampingLaw>(*damping_law, "damping_law");
  fork.damping = per_dof<double>(damping, "damping");
  fork.dofs = per_dof<bool>(dofs, "dofs");
  simulation::DynamicsChange dynamics;
  if (integrator) dynamics.integrator = value_of<dynamics::IntegratorKind>(*integrator, "integrator");
  dynamics.step = step;
  dynamics.tolerance = tolerance;
  return of.change(fork, dynamics, hand);
}

std::size_t push_motion(Simulation& to, const Motion& motion, std::size_t hand) {
  bool pressed = false;
  std::size_t added = 0;
  for (const motion::StylusSample& sample : motion.samples) {
    added += to.push_stylus(sample, hand) ? 1 : 0;
    if (sample.button != pressed) to.push_button(sample.t, pressed = sample.button, hand);
  }
  return added;
}

std::map<std::string, RigidTransform> to_poses(const std::map<std::string, Array>& matrices) {
  std::map<std::string, RigidTransform> poses;
  for (const auto& [name, matrix] : matrices) poses[name] = to_pose(matrix, name);
  return poses;
}

Array twists(const Simulation& of) {
  const auto& objects = of.objects();
  Array all({objects.size(), std::size_t{6}});
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      all.mutable_at(i, k) = objects[i].V_WO_W.linear[k];
      all.mutable_at(i, 3 + k) = objects[i].V_WO_W.angular[k];
    }
  }
  return all;
}

py::array_t<bool> flags(const Simulation& of, bool bodies::BodyState::*flag) {
  py::array_t<bool> all(static_cast<py::ssize_t>(of.objects().size()));
  for (std::size_t i = 0; i < of.objects().size(); ++i) all.mutable_at(i) = of.objects()[i].*flag;
  return all;
}

std::vector<std::string> names(const Simulation& of) {
  std::vector<std::string> all;
  for (const bodies::BodyState& object : of.objects()) all.push_back(object.name);
  return all;
}

void bind_scene(py::module& module) {
  using scene::Scene;
  py::class_<Scene>(module, "Scene",
                    "Bodies, materials and gravity of a scene, read from a URDF and the YAML file next to it.")
      .def_readonly("name", &Scene::name, "Name of the scene: the name of its URDF file without .urdf.")
      .def_readonly("path", &Scene::path, "Path of the URDF.")
      .def_readonly("gravity", &Scene::gravity, "Gravity along -z of the world [m/s²].")
      .def_property_readonly(
          "contact", [](const Scene& s) { return word(s.contact); }, "Contact mode: none, stop or dynamic.")
      .def_readonly("tool", &Scene::tool, "Name of the tool with which each hand starts.")
      .def_property_readonly(
          "masses",
          [](const Scene& s) {
            std::map<std::string, double> masses;
            for (const scene::Body& body : s.bodies) {
              if (body.movable) masses[body.name] = body.mass_properties.mass;
            }
            return masses;
          },
          "Mass of each movable object [kg], by name.")
      .def_readonly("warnings", &Scene::warnings, "Repairs that were made on loading, one line each.");
  module.def(
      "load_scene",
      [](const std::string& path, const std::vector<std::string>& roots) { return scene::load_scene(path, roots); },
      py::arg("path"), py::arg("roots") = std::vector<std::string>{},
      R"(Reads a scene from a URDF (a path or package:// URI) and from the YAML file of the same name next to it,
if there is one.

roots: folders. If any are given, all files that the scene names must be in one of them or in a ROS package. Raises
InputError if a file cannot be read or is not valid.)");
}

void bind_state_access(py::class_<Simulation>& type) {
  type.def_property_readonly("time", &Simulation::time,
                             "Simulated time [s]. It begins at the time of the first sample, or at the first t_end of "
                             "advance_to() if earlier.")
      .def_property_readonly("newest_sample_time", &Simulation::newest_sample_time,
                             "Time of the newest sample of any hand, or `time` if there is none [s].")
      .def_property_readonly("names", &names, "Names of the movable objects, in the order of all arrays.")
      .def_property_readonly(
          "poses",
          [](const Simulation& s) {
            return to_arrays(s.objects().size(), [&](std::size_t i) { return s.objects()[i].X_WO; });
          },
          "Poses of the objects in world, at their centres of mass, positions in m; shape (n, 4, 4).")
      .def_property_readonly(
          "twists", &twists,
          "Velocity [m/s] of each object's centre of mass and angular velocity [rad/s], world axes; shape (n, 6).")
      .def_property_readonly(
          "held", [](const Simulation& s) { return flags(s, &bodies::BodyState::held); },
          "True for each object that a hand holds; shape (n,).")
      .def_property_readonly(
          "in_contact", [](const Simulation& s) { return flags(s, &bodies::BodyState::in_contact); },
          "True for each object that touches another body or the bench; shape (n,).")
      .def_property_readonly(
          "asleep", [](const Simulation& s) { return flags(s, &bodies::BodyState::asleep); },
          "True for each object that is asleep: at rest, and not simulated until something moves it; shape (n,).")
      .def_property_readonly(
          "contacts", &Simulation::contacts,
          "The present contacts, and the contacts that ended in the last call of `advance_to`: a list of ContactState.")
      .def("tool", &Simulation::tool, py::arg("hand") = 0, "Returns the state of the tool in a hand.")
      .def_property_readonly("elastic_energy", &Simulation::elastic_energy, "Energy stored in all tools [J].")
      .def_property_readonly("energy", &Simulation::energy,
                             "Energy of tools and objects [J]: elastic, kinetic, and potential (zero at z = 0). It "
                             "excludes the energy stored in compliant materials.")
      .def("save", &Simulation::save, "Returns the whole state, from which restore() continues bit-identically.")
      .def("restore", &Simulation::restore, py::arg("state"),
           "Restores a state that a simulation with the same scene and settings saved. The future is then "
           "bit-identical. Raises InputError, and changes nothing, if bodies, contact mode, number of styluses or "
           "shape of the fork differ. Other settings are not compared.")
      .def_property_readonly(
          "state_hash", [](const Simulation& s) { return math::to_hex(s.state_hash()); },
          "Hash of the whole state: 16 hexadecimal digits.");
}

void bind_changes(py::class_<Simulation>& type) {
  type.def(
          "select_tool",
          [](Simulation& s, const std::string& tool, std::optional<std::size_t> hand) {
            return s.select_tool(value_of<tools::Tool>(tool, "tool"), hand);
          },
          py::arg("tool"), py::arg("hand") = py::none(),
          "Changes the tool in a hand or, with None, in every hand: spring, spring_fork, spring_probe, direct or ray. "
          "The hand keeps its object. The probe cannot hold an object, so a change to spring_probe releases it.")
      // By name only, says the stub: pybind11 before 2.6 cannot.
      .def("change", &change, py::arg("stiffness") = py::none(), py::arg("damping_ratio") = py::none(),
           py::arg("dofs") = py::none(), py::arg("integrator") = py::none(), py::arg("step") = py::none(),
           py::arg("tolerance") = py::none(), py::arg("damping_coefficient") = py::none(),
           py::arg("damping_law") = py::none(), py::arg("damping") = py::none(), py::arg("hand") = py::none(),
           R"(Changes the fork of a hand or, with None, of every hand, and the integration of all hands. It changes all
or nothing. Values that are None are not changed. A value per DOF is a list of three, for stretch, bend and torsion.

- stiffness: per DOF [N/m, N/m, N m/rad].
- damping_ratio: per DOF, 0 to 10; 1 is critical.
- damping_coefficient: per DOF [N s/m, N s/m, N m s/rad].
- damping_law: per_dof, modal or coefficients.
- damping: per DOF, coefficients with the law coefficients and ratios with the others. Ratios that are not all equal
  change the law modal to per_dof, unless damping_law asks for modal.
- dofs: per DOF, True if it is on and False if it is rigid.
- integrator: a name from integrators().
- step: largest step [s].
- tolerance: allowed error of the whole run [m]; 0 for fixed steps.

Raises InputError if a value is not allowed.)")
      .def("calibrate", &Simulation::calibrate, py::arg("hand") = py::none(),
           "Calibrates the tool of a hand or, with None, of every hand to the object that it holds. With the setting "
           "`calibrate: world` it restores the scene's stiffness instead. Raises InputError if no fork or spring holds "
           "an object.")
      .def("release", &Simulation::release, py::arg("hand") = py::none(),
           "Releases the object of a hand or, with None, of every hand. Returns False if nothing was held.")
      .def(
          "place", [](Simulation& s, const std::map<std::string, Array>& poses) { s.place(to_poses(poses)); },
          py::arg("poses"),
          R"(Releases all objects and places the named ones at rest. poses: from the name of an object to its pose,
shape (4, 4). Unsupported objects then fall.

Raises InputError, and changes nothing, if no movable object has such a name or a pose is invalid.)")
      .def(
          "edit",
          [](Simulation& s, const std::string& action, const std::string& name, const std::string& urdf,
             const std::optional<Array>& pose, std::optional<double> mass, std::optional<double> friction) {
            using Action = simulation::ObjectEdit::Action;
            simulation::ObjectEdit edit;
            edit.action = value_of<Action>(action, "action");
            if ((edit.action == Action::mass && !mass) || (edit.action == Action::friction && !friction))
              throw validation::InputError("edit: missing required argument " + action);
            edit.name = name;
            edit.urdf = urdf;
            if (pose) edit.X_WL = to_pose(*pose, "pose");
            edit.mass = mass.value_or(0.0);
            edit.friction = friction.value_or(0.0);
            return s.edit(edit);
          },
          py::arg("action"), py::arg("name"), py::arg("urdf") = "", py::arg("pose") = py::none(),
          py::arg("mass") = py::none(), py::arg("friction") = py::none(),
          R"(Changes the object `name`, all or nothing. Everything else continues as it is.

- action add: adds the object of the file `urdf` (a path or package:// URI), at `pose` or, without one, on the bench.
- action move: moves the object to `pose`.
- action remove: removes the object.
- action mass: sets the mass to `mass` [kg]; 0 makes the object massless.
- action friction: sets the Coulomb coefficient to `friction`.

pose: pose of the object's URDF link frame in world, shape (4, 4). Raises InputError if the object or a value is not
allowed.)")
      .def("reset", &Simulation::reset,
           "Releases all objects, returns them to their start poses and forgets all samples. Time starts again.");
}

void update(SimulationSettings& settings, const py::dict& values) {
  simulation::apply_settings(to_yaml(values, ""), "", settings);
}

SimulationSettings to_settings(const py::dict& values) {
  SimulationSettings settings;
  update(settings, values);
  return settings;
}

}  // namespace

void bind_settings(py::module& module) {
  using simulation::SettingDescription;
  py::class_<SettingDescription>(module, "SettingDescription", "Description of one setting.")
      .def_readonly("key", &SettingDescription::key, "Key of the setting, with dots.")
      .def_readonly("type", &SettingDescription::type, "Type of the value.")
      .def_readonly("unit", &SettingDescription::unit, "SI unit of the value.")
      .def_readonly("allowed", &SettingDescription::allowed, "Values that are allowed.")
      .def_readonly("default", &SettingDescription::default_value, "Default value, as text.")
      .def_readonly("meaning", &SettingDescription::meaning, "Effect of the setting, in one line.");
  module.def("setting_descriptions", &simulation::setting_descriptions, "Returns the descriptions of all settings.");
  py::class_<SimulationSettings>(
      module, "SimulationSettings",
      "Settings of a simulation by key. Each value is checked when it is set; combinations are "
      "checked by Simulation. setting_descriptions() explains each key. Settings cannot "
      "be read back: keep the dictionary.")
      .def(py::init(&to_settings), py::arg("values") = py::dict(),
           "values: a dictionary, nested or with dotted keys, as in a settings file. Raises InputError for an unknown "
           "key, a wrong type or a value that is not allowed.")
      .def("update", &update, py::arg("values"),
           "Sets these values, all or none. Raises InputError as the constructor does.");
}

void bind_simulation(py::module& module) {
  bind_scene(module);
  py::class_<Simulation> type(module, "Simulation", R"(Simulation of a scene with hands and their tools.

    simulation = Simulation(load_scene("box.urdf"))
    for t in (0.0, 0.5, 1.0):  # the hand moves up; the fork points down, into the box
        simulation.push_stylus(t, pose([0.0, 0.0, 0.24 + 0.1 * t], [1.0, 0.0, 0.0, 0.0]))
    simulation.push_button(0.0, True)
    simulation.advance_to(1.0)
    print(simulation.poses[0][:3, 3])

- Hands: `hand` is 0 for the first stylus (nodes count styluses from 1), at most the setting `styluses` - 1. Another
  number raises InputError, and a negative one TypeError. To hold an object without a button, use the setting
  `grasp.object`. To begin without a hand, place() objects in the air and call advance_to().
- Order: before you advance to a time, push everything that happens up to it. Poses, buttons and wrenches may come in
  any order relative to each other, but the poses of one hand, and its wrenches, in the order of their times.
- Time: a simulation reads no clock and starts no thread. The same sequence of calls gives bit-identical results on
  processors of the same kind (with AVX and FMA, or without). No result is ever NaN.
- Copies: arrays are copies. To copy a simulation, restore its saved state in a new one of the same scene and settings.
  A simulation is not thread-safe.)");
  type.def(py::init([](const scene::Scene& scene, const std::variant<SimulationSettings, py::dict>& settings) {
             if (const auto* ready = std::get_if<SimulationSettings>(&settings)) return Simulation(scene, *ready);
             return Simulation(scene, to_settings(std::get<py::dict>(settings)));
           }),
           py::arg("scene"), py::arg_v("settings", SimulationSettings(), "SimulationSettings()"),
           "Starts a simulation of `scene`. settings: SimulationSettings, or the dictionary for it. Raises InputError "
           "if a setting is not allowed or does not match the scene.")
      .def(
          "push_stylus",
          [](Simulation& s, double t, const Array& pose, std::size_t hand) {
            return s.push_stylus({t, to_pose(pose, "pose")}, hand);
          },
          py::arg("t"), py::arg("pose"), py::arg("hand") = 0,
          R"(Adds a pose of the stylus in world, shape (4, 4) [m], at time t [s]. Its z axis points along the fork,
from the hand to the tip.

The hand moves smoothly between poses and rests after the last one. If the gap between two poses is longer than the
setting `dropout_after` (0.5 s), the hand stays at the first until the time of the second, and then jumps to it. Returns
False, and ignores the pose, if t is not later than the time of the newest one. Raises InputError if the pose is
invalid.)")
      .def("push_button", &Simulation::push_button, py::arg("t"), py::arg("pressed"), py::arg("hand") = 0,
           "Presses (True) or releases (False) the grasp button at time t [s]. Raises InputError if t is not finite.")
      .def("push_next_tool", &Simulation::push_next_tool, py::arg("t"), py::arg("hand") = 0,
           "Selects the next tool at time t [s] or, while something is held, the next tool that can hold it. Raises "
           "InputError if t is not finite.")
      .def("push_clutch", &Simulation::push_clutch, py::arg("t"), py::arg("on"), py::arg("hand") = 0,
           "Switches the clutch at time t [s]. While it is on, the tool and its object stay in place and the hand "
           "moves alone. Once it is off, they follow the hand's further motion from there. Raises InputError if t is "
           "not finite.")
      .def(
          "push_external_wrench",
          [](Simulation& s, double t, const Array& wrench, const std::string& axes, std::size_t hand) {
            using motion::ExternalWrench;
            s.push_external_wrench({t, to_wrench(wrench, "wrench"), value_of<ExternalWrench::Axes>(axes, "axes")},
                                   hand);
          },
          py::arg("t"), py::arg("wrench"), py::arg("axes") = "world", py::arg("hand") = 0,
          R"(Adds a force [N] and a moment [N m] on the held object at the tip, shape (6,), measured at time t [s].

axes: world, or tip (the axes turn with the tip). The wrench is in real units: it is multiplied by the scene's
force_scale. It acts until the next wrench, but at most for the setting `external_wrench_timeout`. It replaces pending
wrenches of its own or a later time. Raises InputError if a value is not allowed.)")
      .def("push_motion", &push_motion, py::arg("motion"), py::arg("hand") = 0,
           R"(Adds the samples and button edges of a recorded motion. Returns the number of samples that were added.

Like push_stylus, it ignores each pose whose time is not later than the time of the newest one. Raises InputError if a
pose is invalid; the samples before it are then added.)")
      .def("advance_to", &Simulation::advance_to, py::arg("t_end"),
           py::arg("pause_at") = std::numeric_limits<double>::infinity(), py::call_guard<py::gil_scoped_release>(),
           R"(Simulates up to time t_end [s], in steps that also end at the samples. Returns an AdvanceReport.

Stops after the step that reaches `pause_at` [s]; a further call with the same t_end continues, and together they take
the same steps as one call without a pause.

If t_end is not later than `time`, no time passes, but buttons that were pushed for times up to `time` still act. Raises
InputError if t_end is not finite.)");
  bind_state_access(type);
  bind_changes(type);
}

}  // namespace spring_workbench::python
