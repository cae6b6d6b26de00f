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

void bind_tool(py::module& module) {
  using tools::ToolState;
  const auto per_dof = [](const rod::PerDof& values) {
    return to_array(Vector3d(values.stretch, values.bend, values.torsion));
  };
  py::class_<ToolState>(module, "ToolState",
                        "State of the tool in one hand at one moment. A pose is a 4 x 4 array that takes coordinates "
                        "of its frame to world, positions in m.")
      .def_readonly("present", &ToolState::present, "True once a sample of this hand has arrived.")
      .def_property_readonly(
          "tool", [](const ToolState& s) { return word(s.tool); },
          "Name of the tool: spring_fork, spring, spring_probe, direct or ray.")
      .def_readonly("held_object", &ToolState::held_object, "Name of the held object; empty if nothing is held.")
      .def_readonly("touched", &ToolState::touched,
                    "Name of the body that the probe touches (`workbench`: the bench); empty if it touches none.")
      .def_property_readonly(
          "shape", [](const ToolState& s) { return word(s.shape); },
          "Shape model of the fork: constant, linear or bushing.")
      .def_property_readonly(
          "integrator", [](const ToolState& s) { return word(s.integrator); },
          "Name of the integrator; see integrators().")
      .def_readonly("length", &ToolState::length, "Rest length of the fork [m].")
      .def_property_readonly(
          "dofs",
          [](const ToolState& s) {
            return std::array<bool, 3>{s.dofs.stretch, s.dofs.bend, s.dofs.torsion};
          },
          "True for each DOF of stretch, bend and torsion that is on. The fork is rigid in a DOF that is off.")
      .def_property_readonly(
          "stiffness", [=](const ToolState& s) { return per_dof(s.stiffness); },
          "Stiffness of stretch, bend [N/m] and torsion [N m/rad]; shape (3,).")
      .def_property_readonly(
          "damping_ratio", [=](const ToolState& s) { return per_dof(s.damping_ratio); },
          "Damping ratio of stretch, bend and torsion, used by the laws per_dof and modal; shape (3,).")
      .def_property_readonly(
          "damping_coefficient", [=](const ToolState& s) { return per_dof(s.damping_coefficient); },
          "Damping coefficient of stretch, bend [N s/m] and torsion [N m s/rad], used by the law coefficients; shape "
          "(3,).")
      .def_property_readonly(
          "damping_law", [](const ToolState& s) { return word(s.damping_law); },
          "Damping law in force: per_dof, modal or coefficients.")
      .def_property_readonly(
          "strain", [](const ToolState& s) { return to_array(s.strain); },
          "Strain coordinates of the shape model: bend and torsion [1/m], stretch [-]. The coordinates of bushing are "
          "displacements [m] and a rotation vector [rad]. Zero while nothing is held; shape (n,), n at most 6.")
      .def_readonly("stretch", &ToolState::stretch, "Extension along the fork [m].")
      .def_property_readonly(
          "bend", [](const ToolState& s) { return to_array(s.bend); },
          "Deflection of the tip along x and y of the handle [m]; shape (2,).")
      .def_readonly("torsion", &ToolState::torsion, "Angle of torsion about the fork [rad].")
      .def_property_readonly(
          "stylus_pose", [](const ToolState& s) { return to_array(s.X_WS); },
          "Pose of the stylus in world; shape (4, 4).")
      .def_property_readonly(
          "handle_pose", [](const ToolState& s) { return to_array(s.X_WH); },
          "Pose of the handle in world; shape (4, 4).")
      .def_property_readonly(
          "proxy_handle_pose", [](const ToolState& s) { return to_array(s.X_WH_proxy); },
          "Pose of the proxy handle in world, from which the fork acts. It stays behind `handle_pose` if the object "
          "cannot follow; shape (4, 4).")
      .def_property_readonly(
          "tip_pose", [](const ToolState& s) { return to_array(s.X_WE); }, "Pose of the tip in world; shape (4, 4).")
      .def_property_readonly(
          "tip_wrench", [](const ToolState& s) { return to_array(s.tip_wrench_W); },
          "Force [N] on the object and its moment [N m] about the tip, world axes; shape (6,).")
      .def_property_readonly(
          "handle_wrench", [](const ToolState& s) { return to_array(s.handle_wrench_H); },
          "Force [N] on the hand and its moment [N m] about the handle's origin, axes of the handle; shape (6,).")
      .def_readonly("elastic_energy", &ToolState::elastic_energy, "Energy stored in the tool [J].")
      .def_readonly("kinetic_energy", &ToolState::kinetic_energy, "Kinetic energy of the held object, in world [J].")
      .def_readonly("error_bound", &ToolState::error_bound,
                    "Bound of the error of integration in position [m], accumulated since the grasp or since the last "
                    "step without a bound. It is an upper estimate, not rigorous. None in contact, or if the "
                    "setting `error_bound` is off.")
      .def_readonly("weight", &ToolState::weight,
                    "Reading as a scale [vkg: virtual kg]: upward force on the object divided by g.")
      .def_readonly("torque", &ToolState::torque,
                    "Reading as a torque wrench [N m]: moment about the tool's axis at the tip.")
      .def_readonly("stretching_force", &ToolState::stretching_force,
                    "Axial force at the handle, > 0 in tension [N] (the paper, section 4).")
      .def_readonly("bending_force", &ToolState::bending_force,
                    "Transverse force at the handle [N] (the paper, section 4).")
      .def_readonly("force_angle", &ToolState::force_angle,
                    "Angle between the tool's axis and the force on it, 0 to pi [rad] (the paper, section 4).")
      .def_readonly("load", &ToolState::load,
                    "The larger of the tip's force and its moment over the length, relative to the weight of the "
                    "heaviest object or "
                    "of calibration.world.heaviest, 0 to 1; logarithmic if weights span more than a decade.")
      .def_readonly("clutch", &ToolState::clutch, "True while the hand moves without the tool.")
      .def_readonly("material_stiffness", &ToolState::material_stiffness,
                    "Stiffness that the probe reads [N/m]; inf: rigid; 0: no reading.")
      .def_readonly("material_stiffness_uncertainty", &ToolState::material_stiffness_uncertainty,
                    "One standard deviation of `material_stiffness` [N/m].");
}

void bind_contact(py::module& module) {
  using contact::ContactState;
  py::class_<ContactState>(module, "ContactState", "One contact point of an object with another body.")
      .def_readonly("object", &ContactState::object, "Name of the object.")
      .def_readonly("other", &ContactState::other, "Name of the other body; `workbench` is the bench.")
      .def_property_readonly(
          "point", [](const ContactState& c) { return to_array(c.p_W); },
          "Position of the contact point in the world [m]; shape (3,).")
      .def_property_readonly(
          "normal", [](const ContactState& c) { return to_array(c.n_W); },
          "Unit normal of the surface, towards `object`, world axes; shape (3,).")
      .def_readonly("depth", &ContactState::depth, "Depth of penetration along the normal [m].")
      .def_readonly("impulse", &ContactState::impulse, "Normal impulse in the last step [N s].")
      .def_readonly("force", &ContactState::force,
                    "This point's share of the normal force between the two bodies, as a mean over the last 20 ms [N]. "
                    "Once the contact has ended, the force is the share in its last step.")
      .def_readonly("slip_speed", &ContactState::slip_speed,
                    "Speed of the object along the other body's surface [m/s].")
      .def_property_readonly(
          "phase", [](const ContactState& c) { return phase_of(c.phase); },
          "Phase in the last call of `advance_to`: started, persisting or ended.");
}

void bind_report(py::module& module) {
  using simulation::AdvanceReport;
  py::class_<AdvanceReport>(module, "AdvanceReport",
                            R"(Report on one call of `advance_to`.

A step is discarded and repeated as shorter ones if its equation is not solved or its error is too large: that in
position if there is a tolerance, otherwise that in energy; `substeps` counts the discarded attempts. If that does not
help, or the integrator is unstable at high stiffness, an L-stable rule takes the step (`steps_fallback`). If that
fails, too, the fork is rigid for the step or, in contact, the object stays in place (`steps_rejected`). If these three
counters, `stops`, `steps_blocked`, `steps_unsolved` and `time_lost` are 0, nothing unusual happened. In contact a step
may take several integrations.

An error is the result minus the exact solution of the equation of motion. An error bound is an empirical upper
estimate, not a rigorous bound (doc/model.md, "Error bound"). The counters wrench_timeouts and
steps_among_movable are in C++ only.)")
      .def_readonly("steps", &AdvanceReport::steps, "Number of steps taken.")
      .def_readonly("substeps", &AdvanceReport::substeps,
                    "Number of attempts at a step that were discarded and repeated as shorter steps.")
      .def_readonly("simulated_time", &AdvanceReport::simulated_time, "Time simulated by this call [s].")
      .def_readonly("position_error", &AdvanceReport::position_error,
                    "Largest estimate of a step's local error in position [m].")
      .def_readonly("angle_error", &AdvanceReport::angle_error,
                    "Largest estimate of a step's local error in angle [rad].")
      .def_readonly("local_error_bound", &AdvanceReport::local_error_bound,
                    "Largest bound of a step's local error in position [m]; None if no step has one.")
      .def_readonly("error_bound", &AdvanceReport::error_bound,
                    "Largest bound of an object's error in position [m], accumulated since its grasp or since its last "
                    "step without a bound. None if no step has a bound, e.g. because the setting `error_bound` is off.")
      .def_readonly("angle_error_bound", &AdvanceReport::angle_error_bound,
                    "Largest bound of an object's error in angle [rad], accumulated like `error_bound`. None if no "
                    "step has a bound.")
      .def_readonly(
          "integrations_without_bound", &AdvanceReport::integrations_without_bound,
          "Number of integrations without an error bound. If the setting `error_bound` is off, no integration has one.")
      .def_readonly("energy_balance", &AdvanceReport::energy_balance,
                    "Energy created (> 0) or lost (< 0) by the integration itself [J]: the change in the energy of "
                    "object and fork less the work of hand, gravity, damping and contact. Meaningful if "
                    "`stiffest_omega_dt` is below about 1.")
      .def_readonly("energy_error", &AdvanceReport::energy_error, "Sum of the steps' estimated errors in energy [J].")
      .def_readonly("stiffest_omega_dt", &AdvanceReport::stiffest_omega_dt,
                    "Largest product of the stiffest mode's angular frequency and the step.")
      .def_readonly("collision_queries", &AdvanceReport::collision_queries,
                    "Number of queries to the collision library.")
      .def_readonly("stops", &AdvanceReport::stops,
                    "Number of steps in which the fork reached the end of its range: fully compressed or wound up, or "
                    "half a turn of a bushing. Unrelated to the contact mode stop.")
      .def_readonly("steps_fallback", &AdvanceReport::steps_fallback,
                    "Number of integrations by the L-stable rule, in place of the integrator.")
      .def_readonly("steps_blocked", &AdvanceReport::steps_blocked,
                    "Number of steps in which no admissible motion of an object was found, so that it stayed in place.")
      .def_readonly("steps_unsolved", &AdvanceReport::steps_unsolved,
                    "Number of steps, or parts of one, that were accepted although a contact among movable objects was "
                    "left with a residual above 1 µm, was deeper than 0.1 mm, or was lost.")
      .def_readonly("time_lost", &AdvanceReport::time_lost,
                    "Time during which an object did not follow its equation of motion [s].")
      .def_readonly("steps_rejected", &AdvanceReport::steps_rejected,
                    "Number of steps without a usable result (non-finite or out of range).")
      .def_property_readonly("active", &AdvanceReport::active, "Names of the subsystems that ran.")
      .def_property_readonly("skipped", &AdvanceReport::skipped,
                             "Names of the subsystems that the scene did not need.");
  using simulation::ChangeReport;
  py::class_<ChangeReport>(module, "ChangeReport",
                           "Report on a change to a running simulation: its effect on the energy.")
      .def_readonly("elastic_energy_before", &ChangeReport::elastic_energy_before,
                    "Energy stored in all tools just before the change [J].")
      .def_readonly("elastic_energy_after", &ChangeReport::elastic_energy_after,
                    "Energy stored in all tools just after the change [J].")
      .def_readonly("energy_added", &ChangeReport::energy_added, "Increase of `Simulation.energy` by the change [J].")
      .def_readonly("message", &ChangeReport::message, "Description of the change for the user, in one line.");
}

}  // namespace

void bind_states(py::module& module) {
  using simulation::SimulationState;
  bind_tool(module);
  bind_contact(module);
  bind_report(module);
  py::class_<SimulationState>(
      module, "SimulationState",
      "Saved state of a whole simulation, from Simulation.save(). States can be compared and pickled.")
      .def_property_readonly(
          "hash", [](const SimulationState& s) { return math::to_hex(s.hash()); },
          "Hash of the state as 16 hexadecimal digits (in C++ it is the same number as an integer). Equal states have "
          "equal hashes on every machine.")
      .def(
          "__eq__", [](const SimulationState& a, const SimulationState& b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const SimulationState& s) { return static_cast<std::size_t>(s.hash()); })
      .def(py::pickle([](const SimulationState& s) { return simulation::serialise(s); },
                      [](const std::string& text) { return simulation::parse_state(text); }));
}

void bind_motions(py::module& module) {
  py::class_<Motion>(module, "Motion", "Recorded motion of one hand, from read_motion().")
      .def(
          "__len__", [](const Motion& m) { return m.samples.size(); }, "Number of samples.")
      .def_property_readonly(
          "times",
          [](const Motion& m) {
            Eigen::VectorXd t(static_cast<Eigen::Index>(m.samples.size()));
            for (std::size_t i = 0; i < m.samples.size(); ++i) t[static_cast<Eigen::Index>(i)] = m.samples[i].t;
            return to_array(t);
          },
          "Times of the samples since the first one [s]; shape (n,).")
      .def_property_readonly(
          "poses",
          [](const Motion& m) { return to_arrays(m.samples.size(), [&](std::size_t i) { return m.samples[i].X; }); },
          "Poses of the stylus in the frame of the file, which is world for push_motion(), positions in m; shape "
          "(n, 4, 4).")
      .def_property_readonly(
          "buttons",
          [](const Motion& m) {
            py::array_t<bool> pressed(static_cast<py::ssize_t>(m.samples.size()));
            for (std::size_t i = 0; i < m.samples.size(); ++i) pressed.mutable_at(i) = m.samples[i].button;
            return pressed;
          },
          "True for each sample at which the grasp button is down; shape (n,).");
  module.def(
      "read_motion",
      [](const std::string& path) {
        Motion motion;
        const auto source = motion_files::open_motion(path);
        while (const auto sample = source->next()) motion.samples.push_back(*sample);
        return motion;
      },
      py::arg("path"),
      R"(Reads a recording (lines of `t x y z qx qy qz qw [button]` in s and m) or a script of waypoints (*.yaml,
*.yml).

Raises InputError, with file and line, if the file cannot be read or is not valid.)");
}

}  // namespace spring_workbench::python
