"""The Python module: laws that it must satisfy, and input that it must refuse."""
import ast
import inspect
import pathlib
import pickle
import re

import numpy as np
import pytest

import spring_workbench as sw

BOX = str(pathlib.Path(__file__).resolve().parents[2] / "examples/01_lift_a_box/box.urdf")
MOTION = str(pathlib.Path(__file__).resolve().parents[2] / "examples/03_replay_a_motion/lift_and_turn.yaml")
MASS, GRAVITY = 0.5, 9.81  # [kg], [m/s2]; of the scene
DOWN = [1.0, 0.0, 0.0, 0.0]  # the fork points down


def holding(settings=None):
    """A simulation with the box in a hand at rest above the bench."""
    values = {"contact": "none", "grasp": {"object": "box"}, **(settings or {})}
    simulation = sw.Simulation(sw.load_scene(BOX), values)
    for t in [0.0, 10.0]:
        simulation.push_stylus(t, sw.pose([0.0, 0.0, 0.23], DOWN))
    return simulation


def test_a_fork_at_rest_carries_the_weight():
    simulation = holding()
    simulation.advance_to(10.0)
    fork = simulation.tool()
    assert fork.held_object == "box"
    assert fork.weight == pytest.approx(MASS, rel=1e-4)
    assert fork.stretch == pytest.approx(MASS * GRAVITY / fork.stiffness[0], rel=1e-4)
    np.testing.assert_allclose(fork.tip_wrench[:3], [0.0, 0.0, MASS * GRAVITY], atol=1e-3)


def pressed(wrench, axes="world", scale=1.0):
    """State of the fork that holds the box at rest under that wrench."""
    simulation = holding({"external_wrench_timeout": 10.0, "force_scale": scale})
    simulation.push_external_wrench(0.0, wrench, axes=axes)
    simulation.advance_to(9.5)
    return simulation.tool()


def test_a_machine_s_force_is_carried_like_a_weight():
    weight = MASS * GRAVITY
    up = [0.0, 0.0, weight, 0.0, 0.0, 0.0]
    assert pressed(up).stretch == pytest.approx(0.0, abs=1e-6)
    # The tip points down, so along its z the same force is a second weight.
    fork = pressed(up, axes="tip")
    assert fork.stretch == pytest.approx(2.0 * weight / fork.stiffness[0], rel=1e-3)
    fork = pressed([0.0, 0.0, 0.0, 0.0, 0.0, 0.1], scale=2.0)
    np.testing.assert_allclose(fork.tip_wrench[3:], [0.0, 0.0, -0.2], atol=1e-4)


def test_invalid_wrenches_are_refused():
    simulation = holding()
    before = simulation.state_hash
    for wrench in [np.zeros(5), np.zeros((6, 1)), np.full(6, np.nan), np.full(6, 1e6)]:
        with pytest.raises(sw.InputError, match="expected"):
            simulation.push_external_wrench(0.0, wrench)
    with pytest.raises(sw.InputError, match="axes: invalid value 'hand': expected one of world, tip"):
        simulation.push_external_wrench(0.0, np.zeros(6), axes="hand")
    assert simulation.state_hash == before


def test_a_message_quotes_what_is_not_text(tmp_path):
    (tmp_path / "hand.tum").write_bytes(b"0 0 0 \xff 0 0 0 1\n")
    with pytest.raises(sw.InputError, match="hand.tum:1: z: invalid value '\ufffd': expected a number"):
        sw.read_motion(str(tmp_path / "hand.tum"))


def test_a_motion_says_how_much_of_it_was_added():
    simulation, motion = sw.Simulation(sw.load_scene(BOX)), sw.read_motion(MOTION)
    assert simulation.push_motion(motion) == len(motion)
    assert simulation.push_motion(motion) == 0  # all of it is past


def test_states_are_arrays_of_the_documented_shapes():
    simulation = sw.Simulation(sw.load_scene(BOX))
    simulation.push_motion(sw.read_motion(MOTION))
    simulation.advance_to(1.0)
    assert simulation.names == ["box"]
    assert simulation.poses.shape == (1, 4, 4) and simulation.poses.dtype == np.float64
    assert simulation.twists.shape == (1, 6)
    assert simulation.held.tolist() == [True]
    R = simulation.poses[0, :3, :3]
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)
    fork = simulation.tool()
    assert fork.bend.shape == (2,) and fork.tip_pose.shape == (4, 4) and fork.handle_wrench.shape == (6,)
    poses = simulation.poses
    poses[:] = 0.0  # a copy: the simulation does not see it
    assert simulation.poses[0, 3, 3] == 1.0


def test_a_free_body_falls_on_a_parabola():
    simulation = sw.Simulation(sw.load_scene(BOX), {"contact": "none"})
    simulation.advance_to(0.0)
    simulation.place({"box": sw.pose([0.0, 0.0, 5.0])})
    simulation.advance_to(0.5)
    assert simulation.poses[0, 2, 3] == pytest.approx(5.0 - 0.5 * GRAVITY * 0.5**2, abs=1e-9)
    assert simulation.twists[0, 2] == pytest.approx(-GRAVITY * 0.5, abs=1e-9)


def test_objects_are_edited():
    simulation = sw.Simulation(sw.load_scene(BOX))
    simulation.advance_to(0.0)
    simulation.edit("move", "box", pose=sw.pose([0.0, 0.0, 0.5]))
    simulation.edit("mass", "box", mass=2.0)
    simulation.advance_to(0.2)
    height = simulation.poses[0, 2, 3]
    assert height == pytest.approx(0.5 - 0.5 * GRAVITY * 0.2**2, abs=1e-9)
    for action, word in [("paint", "action"), ("move", "pose"), ("mass", "mass"), ("friction", "friction")]:
        with pytest.raises(sw.InputError, match=word):
            simulation.edit(action, "box")
    with pytest.raises(sw.InputError, match="name"):
        simulation.edit("mass", "bin", mass=1.0)
    simulation.edit("remove", "box")
    assert simulation.names == []


def test_an_error_has_a_bound_only_where_one_is_asked_for_and_holds():
    for asked in [False, True]:
        simulation = holding({"error_bound": asked})
        report = simulation.advance_to(2.0)
        for bound in [report.error_bound, report.angle_error_bound, simulation.tool().error_bound]:
            assert (bound is not None) == asked
            assert bound is None or 0.0 < bound < 1e-3
        assert report.integrations_without_bound == (0 if asked else report.steps)


def test_a_motion_is_the_file_s():
    motion = sw.read_motion(MOTION)
    assert len(motion) == 226 and motion.poses.shape == (226, 4, 4)
    assert np.all(np.diff(motion.times) > 0.0)
    pressed = motion.times[motion.buttons]
    assert (pressed[0], pressed[-1]) == pytest.approx((0.7, 3.68))


def test_a_restored_state_has_the_same_future():
    simulation = sw.Simulation(sw.load_scene(BOX))
    simulation.push_motion(sw.read_motion(MOTION))
    simulation.advance_to(2.0)
    state = pickle.loads(pickle.dumps(simulation.save()))
    assert state == simulation.save() and state.hash == simulation.state_hash
    simulation.advance_to(4.5)
    ended = simulation.state_hash
    assert ended != state.hash
    simulation.restore(state)
    assert simulation.time == pytest.approx(2.0)
    simulation.advance_to(4.5)
    assert simulation.state_hash == ended


def test_two_simulations_do_the_same():
    runs = []
    for _ in range(2):
        simulation = sw.Simulation(sw.load_scene(BOX))
        simulation.push_motion(sw.read_motion(MOTION))
        simulation.advance_to(4.5)
        runs.append((simulation.state_hash, simulation.poses))
    assert runs[0][0] == runs[1][0]
    np.testing.assert_array_equal(runs[0][1], runs[1][1])


def test_changes_are_made_completely_or_not_at_all():
    simulation = holding()
    simulation.advance_to(1.0)
    before = simulation.state_hash
    with pytest.raises(sw.InputError, match="step"):
        simulation.change(stiffness=[1000.0, 400.0, 3.0], step=-1.0)
    for wrong in [5.0, [1.0, 2.0], ["a", "b", "c"], "soft"]:
        rule = r"^stiffness: invalid value '.*': expected three numbers \(or None\), for stretch, bend and torsion$"
        with pytest.raises(sw.InputError, match=rule):
            simulation.change(stiffness=wrong)
    with pytest.raises(sw.InputError, match=r"^dofs: invalid value '\[True, False\]': expected three booleans"):
        simulation.change(dofs=[True, False])
    assert simulation.state_hash == before
    simulation.change(stiffness=[1000.0, 400.0, 3.0], integrator="rosenbrock")
    assert simulation.tool().stiffness.tolist() == [1000.0, 400.0, 3.0]
    assert simulation.tool().integrator == "rosenbrock"
    simulation.advance_to(10.0)
    assert simulation.tool().stretch == pytest.approx(MASS * GRAVITY / 1000.0, rel=1e-4)
    simulation.change(stiffness=[None, 500.0, None], damping_ratio=[0.5, None, None], dofs=[None, None, False])
    fork = simulation.tool()
    assert fork.stiffness.tolist() == [1000.0, 500.0, 3.0]
    assert (fork.damping_ratio.tolist(), fork.dofs) == ([0.5, 1.0, 1.0], [True, True, False])


def test_damping_values_belong_to_a_law():
    simulation = holding()
    simulation.advance_to(1.0)
    assert simulation.tool().damping_law == "per_dof"
    simulation.change(damping_law="coefficients", damping_coefficient=[3.0, 2.0, 0.01])
    simulation.change(damping=[30.0, None, None])
    fork = simulation.tool()
    assert (fork.damping_law, fork.damping_coefficient.tolist()) == ("coefficients", [30.0, 2.0, 0.01])
    assert fork.damping_ratio.tolist() == [1.0, 1.0, 1.0]
    words = simulation.change(damping_ratio=[0.7, 0.7, 0.7], dofs=[None, None, False]).message
    assert words.startswith("set: stiffness 2000 N/m, 500 N/m, 5 N m/rad; damping 30 N s/m, 2 N s/m, 0.01 N m s/rad")
    assert words.endswith("(coefficients); DOFs on: stretch, bend")  # without strain nothing has to return to zero
    words = simulation.change(dofs=[False, True, True]).message  # it is stretched by the weight
    assert "DOFs on: bend, torsion; the strain of a DOF that was switched off returns to zero" in words
    simulation.change(damping_law="modal", damping=[0.5, 0.5, 0.5])
    assert "per_dof" in simulation.change(damping=[0.5, 0.6, 0.7]).message
    assert simulation.tool().damping_ratio.tolist() == [0.5, 0.6, 0.7]
    with pytest.raises(sw.InputError, match="^damping_law: invalid value 'rayleigh': expected one of per_dof"):
        simulation.change(damping_law="rayleigh")
    with pytest.raises(sw.InputError, match="^fork.damping: .*per_dof"):
        simulation.change(damping_law="modal")


def test_one_hand_is_changed_alone():
    simulation = holding()
    simulation.advance_to(1.0)
    simulation.change(stiffness=[700.0, None, None], hand=1)
    simulation.select_tool("ray", hand=1)
    assert [simulation.tool(hand).stiffness[0] for hand in (0, 1)] == [2000.0, 700.0]
    assert [simulation.tool(hand).tool for hand in (0, 1)] == ["spring_fork", "ray"]
    simulation.select_tool("spring_fork", hand=None)
    assert [simulation.tool(hand).tool for hand in (0, 1)] == ["spring_fork", "spring_fork"]
    with pytest.raises(sw.InputError, match="nothing to calibrate"):
        simulation.calibrate(hand=1)
    assert simulation.tool().stiffness[0] == 2000.0
    assert "box" in simulation.calibrate(hand=0).message
    assert simulation.tool().stiffness[0] != 2000.0
    assert not simulation.release(hand=1) and simulation.held.tolist() == [True]
    assert simulation.release(hand=0) and simulation.held.tolist() == [False]


def test_changes_report_the_energy_that_they_add():
    simulation = holding()
    simulation.advance_to(10.0)
    stored = simulation.elastic_energy
    height = simulation.poses[0][2, 3]
    assert stored == pytest.approx(0.5 * MASS * GRAVITY * simulation.tool().stretch, rel=1e-3)
    assert simulation.energy == pytest.approx(stored + MASS * GRAVITY * height, rel=1e-9)
    report = simulation.change(stiffness=[4000.0, None, None])
    assert report.energy_added == pytest.approx(stored, rel=1e-6)
    gained = report.elastic_energy_after - report.elastic_energy_before
    assert report.energy_added == pytest.approx(gained, rel=1e-9)
    report = simulation.edit("mass", "box", mass=2.0 * MASS)
    assert report.energy_added == pytest.approx(MASS * GRAVITY * height, rel=1e-3)
    stored = simulation.elastic_energy
    assert simulation.select_tool("direct").energy_added == pytest.approx(-stored, rel=1e-6)


def test_the_buttons_for_the_next_tool_and_the_clutch():
    simulation = holding()
    simulation.advance_to(1.0)
    simulation.push_clutch(1.0, True)
    simulation.push_next_tool(1.0)
    simulation.push_next_tool(1.0, hand=1)
    simulation.advance_to(1.1)
    assert simulation.tool().clutch and not simulation.tool(1).clutch
    assert simulation.tool().tool != "spring_fork" and simulation.held.tolist() == [True]
    simulation.push_clutch(1.1, False)
    simulation.advance_to(1.2)
    assert not simulation.tool().clutch


def test_the_tool_tells_the_force_along_and_across_it():
    """It hangs down, so the weight only stretches it; then a force across bends it, too (the paper, section 4)."""
    simulation = holding()
    simulation.advance_to(10.0)
    fork = simulation.tool()
    weight = MASS * GRAVITY
    assert fork.stretching_force == pytest.approx(weight, rel=1e-4)
    assert fork.bending_force == pytest.approx(0.0, abs=1e-6) and fork.force_angle == pytest.approx(0.0, abs=1e-6)
    assert 0.0 <= fork.load <= 1.0
    fork = pressed([weight, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert fork.stretching_force == pytest.approx(weight, rel=1e-3)
    assert fork.bending_force == pytest.approx(weight, rel=1e-3)
    assert fork.force_angle == pytest.approx(np.pi / 4, rel=1e-3)


def test_an_advance_counts_what_happened():
    simulation = holding({"fork.stiffness.stretch": 1.0, "fork.damping.stretch": 0.0})
    report = simulation.advance_to(1.0)
    assert report.steps > 0 and report.collision_queries == 0
    assert report.stops >= 0 and report.steps_fallback >= 0 and report.energy_error >= 0.0
    assert report.local_error_bound is None


def test_states_and_reports_show_their_fields():
    simulation = holding()
    report, tool = simulation.advance_to(1.0), simulation.tool()
    assert repr(report).startswith("AdvanceReport(") and f"steps={report.steps}," in repr(report)
    assert f"held_object='{tool.held_object}'" in repr(tool) and f"stretch={tool.stretch!r}" in repr(tool)


def test_settings_are_those_of_a_file():
    fork = {"length": 0.25, "dofs": {"bend": False}}
    simulation = holding({"fork.stiffness.stretch": np.float64(800.0), "fork": fork})
    simulation.advance_to(0.1)
    fork = simulation.tool()
    assert (fork.length, fork.stiffness[0], fork.dofs) == (0.25, 800.0, [True, False, True])
    keys = {description.key: description for description in sw.setting_descriptions()}
    assert keys["step"].unit == "s" and keys["integrator"].default in sw.integrators()


@pytest.mark.parametrize(
    "values, words",
    [
        ({"gravity": -1}, ["gravity: invalid value '-1': expected"]),
        ({"gravity": float("nan")}, ["gravity: invalid value '.nan': expected"]),
        ({"stepp": 0.01}, ["stepp", "unknown key"]),
        ({"integrator": "euler"}, ["integrator", "euler", "exponential"]),
        ({"fork": {"length": None}}, ["fork.length: invalid value 'None': expected"]),
    ],
)
def test_bad_settings_are_refused(values, words):
    scene = sw.load_scene(BOX)
    settings = sw.SimulationSettings()
    messages = set()
    for call in [sw.SimulationSettings, settings.update, lambda values: sw.Simulation(scene, values)]:
        with pytest.raises(sw.InputError) as refused:
            call(values)
        messages.add(str(refused.value))
    (message,) = messages
    for word in words:
        assert word in message


def test_a_dictionary_of_settings_makes_the_same_simulation():
    scene, values = sw.load_scene(BOX), {"contact": "none", "fork": {"length": 0.25}, "step": 0.01}
    simulation = sw.Simulation(scene, values)
    assert simulation.tool().length == 0.25
    assert simulation.state_hash == sw.Simulation(scene, settings=sw.SimulationSettings(values)).state_hash
    with pytest.raises(TypeError):
        sw.Simulation(scene, 5.0)


def test_invalid_poses_are_refused():
    simulation = holding()
    for matrix in [np.eye(3), np.full((4, 4), np.nan), 2.0 * np.eye(4), np.diag([1.0, 1.0, -1.0, 1.0])]:
        with pytest.raises(sw.InputError, match="pose: expected"):
            simulation.push_stylus(20.0, matrix)
    with pytest.raises(sw.InputError):
        sw.pose([0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0])
    with pytest.raises(sw.InputError):
        sw.pose([0.0, 0.0])
    with pytest.raises(sw.InputError, match="none.urdf"):
        sw.load_scene("none.urdf")
    assert issubclass(sw.InputError, ValueError)


def test_hands_times_and_names_that_do_not_exist_are_refused():
    simulation = holding()
    simulation.advance_to(1.0)
    before = simulation.state_hash
    hand = "hand: invalid value '5': expected an integer between 0 and 1"
    for call in [
        simulation.tool,
        lambda hand: simulation.push_button(1.0, True, hand),
        lambda hand: simulation.push_stylus(20.0, np.eye(4), hand),
        lambda hand: simulation.select_tool("spring", hand),
    ]:
        with pytest.raises(sw.InputError, match=hand):
            call(5)
    for t in [np.nan, np.inf, -np.inf]:
        with pytest.raises(sw.InputError, match="t_end: invalid value '.*': expected a finite number in s$"):
            simulation.advance_to(t)
        with pytest.raises(sw.InputError, match="t: invalid value '.*': expected a finite number in s$"):
            simulation.push_button(t, True)
    with pytest.raises(sw.InputError, match=r"^name: invalid value 'bin': expected a movable object of .*\(box\)$"):
        simulation.place({"bin": sw.pose([0.0, 0.0, 1.0]), "box": sw.pose([0.0, 0.0, 5.0])})
    assert simulation.held.tolist() == [True] and simulation.state_hash == before


def test_advancing_to_the_past_takes_no_time():
    simulation = holding()
    simulation.advance_to(1.0)
    before = simulation.state_hash
    report = simulation.advance_to(0.5)
    assert (simulation.time, report.steps, report.simulated_time) == (1.0, 0, 0.0)
    assert simulation.state_hash == before


def test_everything_public_has_a_docstring():
    for name in sw.__all__:
        thing = getattr(sw, name)
        assert thing.__doc__, name


def docstring(thing):
    """The words of a stub's or a module's docstring, without the signature that pybind11 puts before it."""
    text = ast.get_docstring(thing) if isinstance(thing, ast.AST) else inspect.getdoc(thing)
    return re.sub(r"\A\w+\([^\n]*\) -> [^\n]*\n\n", "", text or "").split()


def test_the_stubs_have_the_docstrings_of_the_module():
    stubs = ast.parse((pathlib.Path(sw.__file__).parent / "_core.pyi").read_text())
    for stub in stubs.body:
        if not isinstance(stub, (ast.ClassDef, ast.FunctionDef)):
            continue
        thing = getattr(sw, stub.name)
        assert docstring(stub) == docstring(thing), stub.name
        for member in getattr(stub, "body", []) if isinstance(stub, ast.ClassDef) else []:
            if not isinstance(member, ast.FunctionDef) or member.name in ("__eq__", "__hash__"):
                continue
            name = stub.name + "." + member.name
            assert docstring(member) and docstring(member) == docstring(getattr(thing, member.name)), name
