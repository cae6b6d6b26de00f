#include "bindings.h"

namespace spring_workbench::python {

namespace py = pybind11;

namespace {

const char* phase_of(contact::ContactPhase phase) {
  switch (phase) {
    case contact::ContactPhase::started:
      return "started";
    case contact::ContactPhase::persisting:
      return "persisting";
    case contact::ContactPhase::ended:
      break;
  }
  return "ended";
}

void bind_fork(py::module_& module) {
  using tools::ToolState;
  const auto per_dof = [](const rod::PerDof& values) {
    return to_array(Vector3d(values.stretch, values.bend, values.torsion));
  };
  py::class_<ToolState>(module, "Fork", "The tool in a hand and what it does, at one moment.")
      .def_readonly("present", &ToolState::present, "Whether a sample of this hand is known.")
      .def_property_readonly("tool", [](const ToolState& s) { return word(s.tool); })
      .def_readonly("held_object", &ToolState::held_object, "Name; empty if nothing is held.")
      .def_readonly("touched", &ToolState::touched,
                    "The body that the probe touches, `workbench` for the bench; otherwise empty.")
      .def_property_readonly("shape", [](const ToolState& s) { return word(s.shape); })
      .def_property_readonly("integrator", [](const ToolState& s) { return word(s.integrator); })
      .def_readonly("length", &ToolState::length, "Rest length [m].")
      .def_property_readonly(
          "dofs",
          [](const ToolState& s) {
            return std::array<bool, 3>{s.dofs.stretch, s.dofs.bend, s.dofs.torsion};
          },
          "Whether stretching, bending and twisting are on.")
      .def_property_readonly(
          "stiffness", [=](const ToolState& s) { return per_dof(s.stiffness); },
          "Stiffness of stretching, bending [N/m] and twisting [N m/rad]; shape (3,).")
      .def_property_readonly(
          "damping_ratio", [=](const ToolState& s) { return per_dof(s.damping_ratio); },
          "Damping ratio of stretching, bending and twisting; shape (3,).")
      .def_property_readonly(
          "strain", [](const ToolState& s) { return to_array(s.strain); },
          "Coordinates of the shape model; shape (n,), n at most 6.")
      .def_readonly("stretch", &ToolState::stretch, "Extension along the fork [m].")
      .def_property_readonly(
          "bend", [](const ToolState& s) { return to_array(s.bend); },
          "Deflection of the tip along x and y of the handle [m]; shape (2,).")
      .def_readonly("torsion", &ToolState::torsion, "Twist angle [rad].")
      .def_property_readonly(
          "stylus", [](const ToolState& s) { return to_array(s.X_WS); }, "Pose of the stylus; shape (4, 4).")
      .def_property_readonly(
          "handle", [](const ToolState& s) { return to_array(s.X_WH); }, "Pose of the handle; shape (4, 4).")
      .def_property_readonly(
          "proxy_handle", [](const ToolState& s) { return to_array(s.X_WH_proxy); },
          "Pose of the proxy handle; shape (4, 4).")
      .def_property_readonly(
          "tip", [](const ToolState& s) { return to_array(s.X_WE); }, "Pose of the tip; shape (4, 4).")
      .def_property_readonly(
          "tip_wrench", [](const ToolState& s) { return to_array(s.tip_wrench_W); },
          "Force [N] and moment [N m] on the object at the tip, world axes; shape (6,).")
      .def_property_readonly(
          "handle_wrench", [](const ToolState& s) { return to_array(s.handle_wrench_H); },
          "Wrench on the hand, in the handle's frame; shape (6,).")
      .def_readonly("elastic_energy", &ToolState::elastic_energy, "Energy stored in the fork [J].")
      .def_readonly("kinetic_energy", &ToolState::kinetic_energy, "Kinetic energy of the held object [J].")
      .def_readonly("weight", &ToolState::weight, "Upward force on the object divided by g [kg].")
      .def_readonly("torque", &ToolState::torque, "Moment about the fork's axis at the tip [N m].")
      .def_readonly("material_stiffness", &ToolState::material_stiffness,
                    "Reading of the probe [N/m]; inf: rigid; 0: no reading.");
}

void bind_contact(py::module_& module) {
  using contact::ContactState;
  py::class_<ContactState>(module, "Contact", "A contact of an object, world axes.")
      .def_readonly("object", &ContactState::object)
      .def_readonly("other", &ContactState::other, "Another object's name, or `workbench`.")
      .def_property_readonly(
          "point", [](const ContactState& c) { return to_array(c.p_W); }, "[m]; shape (3,).")
      .def_property_readonly(
          "normal", [](const ContactState& c) { return to_array(c.n_W); }, "Unit vector towards `object`; shape (3,).")
      .def_readonly("depth", &ContactState::depth, "Penetration [m].")
      .def_readonly("impulse", &ContactState::impulse, "Normal impulse in the last step [N s].")
      .def_readonly("force", &ContactState::force, "Mean normal force over that step [N].")
      .def_readonly("slip_speed", &ContactState::slip_speed, "[m/s].")
      .def_property_readonly(
          "phase", [](const ContactState& c) { return phase_of(c.phase); }, "started, persisting or ended.");
}

void bind_report(py::module_& module) {
  using simulation::AdvanceReport;
  py::class_<AdvanceReport>(module, "Report", "What a call of `advance` did.")
      .def_readonly("steps", &AdvanceReport::steps, "Steps taken.")
      .def_readonly("substeps", &AdvanceReport::substeps,
                    "Attempts repeated with a shorter step because of their error.")
      .def_readonly("simulated_time", &AdvanceReport::simulated_time, "[s].")
      .def_readonly("position_error", &AdvanceReport::position_error, "Largest estimate of a step's local error [m].")
      .def_readonly("angle_error", &AdvanceReport::angle_error, "Likewise for the angle [rad].")
      .def_readonly("energy_added", &AdvanceReport::energy_added, "Energy added by integration [J].")
      .def_readonly("stiffest_omega_dt", &AdvanceReport::stiffest_omega_dt,
                    "Frequency of the stiffest mode times the step.")
      .def_readonly("steps_blocked", &AdvanceReport::steps_blocked,
                    "Steps in which contact admitted no motion of an object.")
      .def_readonly("time_lost", &AdvanceReport::time_lost, "Time during which a body did not follow its equation [s].")
      .def_readonly("steps_rejected", &AdvanceReport::steps_rejected,
                    "Steps rejected: the result was not finite or bounded.")
      .def_readonly("active", &AdvanceReport::active, "Subsystems that ran.")
      .def_readonly("skipped", &AdvanceReport::skipped, "Subsystems that were not needed.");
}

}  // namespace

void bind_states(py::module_& module) {
  using simulation::SimulationState;
  bind_fork(module);
  bind_contact(module);
  bind_report(module);
  py::class_<SimulationState>(module, "State", "A whole simulation between two calls: a value. It can be pickled.")
      .def_property_readonly(
          "hash", [](const SimulationState& s) { return simulation::to_hex(s.hash()); },
          "16 hexadecimal digits, the same on every machine.")
      .def(
          "__eq__", [](const SimulationState& a, const SimulationState& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const SimulationState& s) { return static_cast<std::size_t>(s.hash()); })
      .def(py::pickle([](const SimulationState& s) { return simulation::serialise(s); },
                      [](const std::string& text) { return simulation::parse_state(text); }));
}

void bind_motions(py::module_& module) {
  py::class_<Motion>(module, "Motion", "A recorded hand.")
      .def(
          "__len__", [](const Motion& m) { return m.samples.size(); }, "Number of samples.")
      .def_property_readonly(
          "times",
          [](const Motion& m) {
            Eigen::VectorXd t(static_cast<Eigen::Index>(m.samples.size()));
            for (std::size_t i = 0; i < m.samples.size(); ++i) t[static_cast<Eigen::Index>(i)] = m.samples[i].t;
            return to_array(t);
          },
          "Times since the first sample [s]; shape (n,).")
      .def_property_readonly(
          "poses",
          [](const Motion& m) { return to_arrays(m.samples.size(), [&](std::size_t i) { return m.samples[i].X; }); },
          "Poses of the stylus; shape (n, 4, 4).")
      .def_property_readonly(
          "buttons",
          [](const Motion& m) {
            py::array_t<bool> pressed(static_cast<py::ssize_t>(m.samples.size()));
            for (std::size_t i = 0; i < m.samples.size(); ++i) pressed.mutable_at(i) = m.samples[i].button;
            return pressed;
          },
          "Whether the grasp button is down; shape (n,).");
  module.def(
      "read_motion",
      [](const std::string& path) {
        Motion motion;
        const auto source = motion_files::open_motion(path);
        while (const auto sample = source->next()) motion.samples.push_back(*sample);
        return motion;
      },
      py::arg("path"),
      "Reads a recording (lines of `t x y z qx qy qz qw [button]`), or a script of waypoints (*.yaml). Raises "
      "InputError.");
}

}  // namespace spring_workbench::python
