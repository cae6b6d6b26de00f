#!/usr/bin/python3
"""The node `manipulation` by its topics and services: scenes/single_box, a hand on its own clock."""
import math
import os
import re
import sys
import tempfile
import unittest

import rospy
import rostest
from geometry_msgs.msg import Point, Pose, Quaternion, WrenchStamped
from rosgraph_msgs.msg import Log
from spring_workbench.msg import (
    Contact,
    Contacts,
    ForkState,
    ObjectStates,
    SceneDescription,
    ShapeDescription,
    StepReport,
)
from spring_workbench.srv import (
    Calibrate,
    EditObject,
    LoadScene,
    Release,
    SaveScene,
    SetForkDamping,
    SetForkDofs,
    SetForkStiffness,
    SetIntegrator,
)
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from stack import (
    DOWN,
    Hand,
    Listener,
    diagnostic_values,
    diagnostics_listener,
    product,
    quaternion,
    services_of_manipulation,
    stylus_transform,
    wait_for,
)

NAN = float("nan")
LENGTH, MASS, GRAVITY = 0.2, 1.0, 9.81
BRICK = "package://spring_workbench/test/integration/data/brick.urdf"
UPRIGHT = Pose(Point(0.3, 0.0, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0))
UNDER = Pose(Point(0.3, 0.0, -0.01), Quaternion(0.0, 0.0, 0.0, 1.0))
IN_BOX = (0.03, 0.0, 0.02 + LENGTH)  # the tip is 3 cm beside the centre of the box
LIFTED = (0.03, 0.0, 0.30 + LENGTH)


class Manipulation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.services = services_of_manipulation(
            {
                "set_dofs": SetForkDofs,
                "set_stiffness": SetForkStiffness,
                "set_damping": SetForkDamping,
                "set_integrator": SetIntegrator,
                "load_scene": LoadScene,
                "calibrate": Calibrate,
                "reset": Trigger,
                "undo": Trigger,
                "edit_object": EditObject,
                "save_scene": SaveScene,
                "release": Release,
            }
        )
        cls.objects = Listener("manipulation/objects", ObjectStates)
        cls.fork = Listener("manipulation/fork", ForkState)
        cls.wrench = Listener("manipulation/wrench", WrenchStamped)
        cls.contacts = Listener("manipulation/contacts", Contacts)
        cls.steps = Listener("manipulation/steps", StepReport)
        cls.tf = Listener("/tf", TFMessage)
        cls.log = Listener("/rosout", Log)
        cls.diagnostics = diagnostics_listener()
        cls.hand = Hand(followed_by=(cls.objects, cls.fork, cls.wrench, cls.steps))
        cls.hand.wait_for_node()

    def setUp(self):
        """Puts the box at its start pose, a new hand above it, and the default fork in the hand."""
        self.call("load_scene", "package://spring_workbench/scenes/single_box.urdf")
        self.call("set_dofs", True, True, True, 0)
        self.call("set_stiffness", 2000.0, 500.0, 5.0, 0)
        self.call("set_damping", 1.0, 1.0, 1.0, "per_dof", 0)
        self.call("set_integrator", "exponential", 0.02, 0.0)
        self.hand.position, self.hand.rotation, self.hand.pressed = (0.03, 0.0, 0.4), DOWN, False
        self.hand.run(0.2)
        self.fork.next(
            lambda m: math.dist((m.handle.position.x, m.handle.position.y, m.handle.position.z), self.hand.position)
            < 1e-9,
            "a fork in this hand",
        )

    def call(self, service, *arguments):
        answer = self.services[service](*arguments)
        self.assertTrue(answer.success, answer.message)
        return answer

    def refused(self, service, *arguments):
        """Calls a service that must fail; returns its one-line message."""
        answer = self.services[service](*arguments)
        self.assertFalse(answer.success)
        self.assertTrue(answer.message)
        self.assertNotIn("\n", answer.message)
        return answer.message

    def box(self, message=None):
        return (message or self.objects.next()).objects[0]

    def grasp(self):
        self.hand.move(IN_BOX, DOWN, 0.5)
        self.hand.run(0.1)
        self.assertTrue(self.box().highlighted)
        self.hand.pressed = True
        self.hand.run(0.2)
        self.assertEqual(self.fork.next().held_object, "box")
        self.assertTrue(self.box().held)

    def lift(self, rotation=DOWN):
        """Grasps the box 3 cm from its centre, lifts and turns it, and waits until everything is at rest."""
        self.grasp()
        self.hand.move(LIFTED, DOWN, 1.0)
        if rotation is not DOWN:
            self.hand.move(LIFTED, rotation, 1.0)
        self.hand.run(2.0)

    def test_lifts_and_feels_the_weight(self):
        self.lift()
        box, fork, wrench = self.box(), self.fork.next(), self.wrench.next()
        self.assertGreater(box.pose.position.z, 0.2)
        self.assertLess(abs(fork.tip_wrench.force.z - MASS * GRAVITY), 1e-3 * MASS * GRAVITY)
        self.assertEqual(wrench.header.frame_id, "fork_handle")
        self.assertLess(abs(wrench.wrench.force.z - MASS * GRAVITY), 0.05 * MASS * GRAVITY)  # z points down
        self.assertGreater(fork.stretch, 0.0)
        self.assertGreater(fork.elastic_energy, 0.0)
        self.assertLess(fork.kinetic_energy, 1e-9)

    def test_frames_and_reports(self):
        self.lift()
        seen = len(self.steps.messages)
        self.hand.run(0.5)
        frames = {t.child_frame_id: t for m in self.tf.messages for t in m.transforms if t.header.frame_id == "world"}
        self.assertLessEqual({"box", "fork_handle", "fork_tip"}, set(frames))
        box = self.box()  # of the single box, link frame and centre-of-mass frame are one
        self.assertAlmostEqual(frames["box"].transform.translation.z, box.pose.position.z, delta=1e-6)
        step = next(m for m in reversed(self.steps.messages) if m.steps > 0)
        self.assertGreater(step.simulated_time, 0.0)
        self.assertEqual(step.integrator, "exponential")
        self.assertIn("stretch", " ".join(step.active))
        values = wait_for(lambda: diagnostic_values(self.diagnostics.messages, "physics loop"), "diagnostics")
        self.assertIn("deadlines missed", values)
        counters = {name for name, kind in zip(StepReport.__slots__, StepReport._slot_types) if kind == "uint32"}
        self.assertLessEqual(counters, set(values))
        self.assertGreater(int(values["steps"]), 0)
        self.assertEqual(sum(m.steps_rejected for m in self.steps.messages[seen:]), 0)
        self.assertAlmostEqual(
            float(diagnostic_values(self.diagnostics.messages, "tracker input")["rate [Hz]"]), 50.0, delta=1.0
        )

    def test_contacts_start_persist_slip_and_end(self):
        seen = len(self.contacts.messages)
        self.grasp()
        self.hand.move((0.03, 0.0, 0.01 + LENGTH), DOWN, 0.5)  # presses the box on the bench
        self.hand.run(0.5)
        pressed = self.contacts.next(lambda m: m.contacts and m.contacts[0].phase == Contact.PERSISTING)
        step = wait_for(
            lambda: next((m for m in self.steps.messages if m.header.stamp == pressed.header.stamp and m.steps), None),
            "the step of these contacts",
        )
        force = sum(c.impulse for c in pressed.contacts) * step.steps / step.simulated_time
        self.assertAlmostEqual(force, MASS * GRAVITY - self.fork.next().tip_wrench.force.z, delta=0.02 * force)
        self.assertEqual(step.steps_blocked, 0)
        self.assertEqual(step.time_lost, 0.0)
        dragged = len(self.contacts.messages)
        self.hand.move((0.23, 0.0, 0.01 + LENGTH), DOWN, 1.0)  # at 0.3 m/s where it is fastest
        slipping = max(c.slip_speed for m in self.contacts.messages[dragged:] for c in m.contacts)
        self.assertTrue(0.1 < slipping < 0.6, slipping)
        self.hand.move((0.23, 0.0, 0.30 + LENGTH), DOWN, 1.0)
        self.hand.run(0.5)
        messages = self.contacts.messages[seen:]
        phases = [c.phase for m in messages for c in m.contacts if c.object == "box" and c.other == "workbench"]
        for phase in (Contact.STARTED, Contact.PERSISTING, Contact.ENDED):
            self.assertIn(phase, phases)
        self.assertFalse(messages[-1].contacts)
        for contact in (c for m in messages for c in m.contacts):
            self.assertAlmostEqual(contact.normal.z, 1.0, delta=1e-6)
            self.assertGreaterEqual(contact.impulse, 0.0)

    def test_markers_are_sent_while_there_is_a_subscriber(self):
        self.hand.run(0.2)
        self.assertIn("markers", self.steps.last.skipped)
        markers = Listener("manipulation/markers", MarkerArray)
        array = self.run_until(markers)
        wait_for(lambda: any("markers" in m.active for m in self.steps.messages), "a report of the markers")
        names = {m.ns for m in array.markers}
        self.assertLessEqual({"workbench", "box", "fork"}, names)
        self.assertNotIn(Marker.DELETEALL, [m.action for m in array.markers])
        markers.subscriber.unregister()

    def test_displays_leave_little_to_markers(self):
        everything, beside = (Listener("manipulation" + t, MarkerArray) for t in ("/markers", "/display/markers"))
        names = [{m.ns for m in self.run_until(listener).markers} for listener in (everything, beside)]
        self.assertEqual(names[0] - names[1], {"workbench", "box", "fork"})
        self.assertLessEqual({"legend", "legend marks"}, names[1])
        everything.subscriber.unregister()
        beside.subscriber.unregister()

    def test_a_late_listener_gets_the_scene(self):
        scenes = Listener("manipulation/scene_description", SceneDescription)
        scene = wait_for(lambda: scenes.last, "the scene")
        self.assertEqual(scene.header.frame_id, "world")
        self.assertEqual([body.name for body in scene.bodies if body.movable], ["box"])
        box = next(body for body in scene.bodies if body.name == "box")
        self.assertEqual((box.mass, len(box.visual), box.visual[0].type), (MASS, 1, ShapeDescription.BOX))
        self.edit("add", "brick", BRICK, at=(0.3, 0.0, 0.4))
        there = lambda s: [body.name for body in s.bodies if body.movable] == ["box", "brick"]
        wait_for(lambda: there(scenes.last), "the added object")
        self.edit("mass", "brick", mass=3.5)
        wait_for(lambda: scenes.last.bodies[-1].mass == 3.5, "its new mass")
        seen = len(scenes.messages)
        self.edit("remove", "brick")
        wait_for(lambda: len(scenes.messages) > seen and not there(scenes.last), "the object to be gone")
        scenes.subscriber.unregister()

    def run_until(self, listener):
        def one():
            self.hand.run(0.05)
            return listener.last

        return wait_for(one, "a message")

    def switch(self, service, *arguments):
        """Changes the fork while the clock is stopped; returns the states just before and just after."""
        before_box, before = self.box(), self.fork.next()
        answer = self.call(service, *arguments)
        after_box, after = self.box(), self.fork.next()
        self.assertEqual(before.header.stamp, after.header.stamp)
        for a, b in [(before_box.pose.position, after_box.pose.position)]:
            self.assertLess(math.dist((a.x, a.y, a.z), (b.x, b.y, b.z)), 1e-9)
        a, b = before_box.pose.orientation, after_box.pose.orientation
        self.assertLess(abs(1.0 - abs(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w)), 1e-12)
        self.assertAlmostEqual(answer.elastic_energy_before, before.elastic_energy, delta=1e-9)
        self.assertAlmostEqual(answer.elastic_energy_after, after.elastic_energy, delta=1e-9)
        return answer, before, after

    def test_switching_while_held_and_twisted(self):
        level = product(
            quaternion((1, 0, 0), math.pi / 2), (0.0, 0.0, 0.0, 1.0)
        )  # the fork is level: the box twists it
        self.lift(level)
        twist = self.fork.next().torsion
        self.assertGreater(abs(twist), 0.01)
        self.switch("set_dofs", True, True, False, 0)
        self.hand.run(2.0)
        off = self.fork.next()
        self.assertEqual((off.torsion_on, off.stretch_on, off.bend_on), (False, True, True))
        self.assertLess(abs(off.torsion), 1e-6)
        self.switch("set_dofs", True, True, True, 0)
        self.hand.run(3.0)
        self.assertAlmostEqual(self.fork.next().torsion, twist, delta=1e-3 * abs(twist))
        answer, before, after = self.switch("set_stiffness", 0.0, 250.0, 0.0, 0)
        self.assertEqual((after.stretch_stiffness, after.bend_stiffness, after.torsion_stiffness), (2000.0, 250.0, 5.0))
        self.assertLess(answer.elastic_energy_after, answer.elastic_energy_before)
        answer, before, after = self.switch("set_damping", 0.5, 0.6, 0.7, "", 0)
        self.assertEqual(
            (after.stretch_damping_ratio, after.bend_damping_ratio, after.torsion_damping_ratio), (0.5, 0.6, 0.7)
        )
        self.assertEqual(answer.elastic_energy_after, answer.elastic_energy_before)
        self.hand.run(0.5)
        self.assertEqual(self.fork.next().held_object, "box")

    def damping(self, *arguments):
        """Calls ~set_damping; returns the fork's law, ratios and coefficients after it."""
        self.call("set_damping", *arguments, 0)
        m = self.fork.next()
        ratios = (m.stretch_damping_ratio, m.bend_damping_ratio, m.torsion_damping_ratio)
        return m.damping_law, ratios, (
            m.stretch_damping_coefficient,
            m.bend_damping_coefficient,
            m.torsion_damping_coefficient,
        )

    def test_damping_values_are_those_of_the_law_in_force(self):
        ones, soft, hard, three = (1.0, 1.0, 1.0), (3.0, 2.0, 0.01), (30.0, 20.0, 0.1), (0.5, 0.6, 0.7)
        self.assertEqual(self.damping(*soft, "coefficients"), ("coefficients", ones, soft))
        self.assertEqual(self.damping(*hard, ""), ("coefficients", ones, hard))
        self.assertEqual(self.damping(*ones, "modal"), ("modal", ones, hard))
        self.assertIn("per_dof", self.refused("set_damping", *three, "modal", 0))
        self.assertEqual(self.damping(*ones, ""), ("modal", ones, hard))
        self.assertEqual(self.damping(*three, ""), ("per_dof", three, hard))

    def test_every_integrator_carries_the_box(self):
        """Moves back and forth, so that the box does not sleep; explicit integrators need short steps."""
        self.lift()
        resting, away = self.box().pose.position, (0.08, 0.05, LIFTED[2])
        for name, step, tolerance in [
            ("paper", 0.01, 0.0),
            ("rk4", 5e-5, 0.0),
            ("semi_implicit_euler", 5e-5, 0.0),
            ("implicit_euler", 0.02, 0.0),
            ("rosenbrock", 0.02, 0.0),
            ("rk4", 0.02, 1e-5),
            ("exponential", 0.02, 0.0),
        ]:
            self.call("set_integrator", name, step, tolerance)
            before = len(self.steps.messages)
            self.hand.move(away, DOWN, 0.4)
            self.assertGreater(self.box().pose.position.x - resting.x, 0.02)
            self.hand.move(LIFTED, DOWN, 0.4)
            self.hand.run(0.6)
            reports = [report for report in self.steps.messages[before:] if report.simulated_time > 0.0]
            self.assertEqual({report.integrator for report in reports}, {name})
            self.assertGreaterEqual(sum(report.steps for report in reports), round(0.8 / step) - 2)
            self.assertEqual(sum(report.steps_rejected for report in reports), 0)
            position = self.box().pose.position
            for axis in "xyz":
                self.assertAlmostEqual(getattr(position, axis), getattr(resting, axis), delta=2e-3, msg=name)

    def test_calibrates_and_releases(self):
        self.assertIn("held", self.refused("calibrate"))
        self.assertIn("held", self.refused("release"))
        self.lift()
        before = self.fork.next()
        self.call("calibrate")
        after = self.fork.next()
        self.assertNotEqual(before.stretch_stiffness, after.stretch_stiffness)
        strained = self.fork.next().elastic_energy
        released = self.call("release")
        self.assertAlmostEqual(released.elastic_energy_before, strained, delta=1e-9)
        self.assertEqual(released.elastic_energy_after, 0.0)
        self.assertAlmostEqual(released.energy_added, -strained, delta=1e-9)
        self.hand.run(0.2)
        self.assertEqual(self.fork.next().held_object, "")
        self.assertFalse(self.box().held)

    def test_reset_returns_all_objects(self):
        self.lift()
        box, fork = self.box(), self.fork.next()
        told = self.call("reset").message
        added = float(re.search(r"; energy added: (\S+) J$", told).group(1))
        fall = MASS * GRAVITY * (0.02 - box.pose.position.z)
        self.assertAlmostEqual(added, fall - fork.elastic_energy - fork.kinetic_energy, delta=1e-6)
        box, fork = self.box(), self.fork.next()
        self.assertAlmostEqual(box.pose.position.z, 0.02, delta=1e-12)
        self.assertEqual(fork.held_object, "")

    def edit(self, action, name, urdf="", at=None, mass=0.0, friction=0.0):
        pose = Pose(Point(*at), Quaternion(0.0, 0.0, 0.0, 1.0)) if at else Pose()
        return self.call("edit_object", action, name, urdf, pose, mass, friction)

    def heights(self):
        return {o.name: o.pose.position.z for o in self.objects.next().objects}

    def test_objects_are_edited_taken_back_and_saved(self):
        self.lift()
        self.edit("mass", "box", mass=2.0)
        self.edit("add", "brick", BRICK, at=(0.3, 0.0, 0.4))
        self.edit("friction", "brick", friction=0.2)
        self.hand.run(4.0)
        fork = self.fork.next()
        self.assertEqual(fork.held_object, "box")
        self.assertAlmostEqual(fork.weight, 2.0, delta=0.02)
        self.assertAlmostEqual(self.heights()["brick"], 0.02, delta=1e-4)  # it has fallen
        self.edit("move", "brick", at=(-0.3, 0.1, 0.0))
        self.hand.run(0.5)
        with tempfile.TemporaryDirectory(dir="/tmp") as folder:
            path = os.path.join(folder, "edited.urdf")
            self.call("save_scene", path)
            before = {o.name: o.pose for o in self.objects.next().objects}
            self.edit("remove", "box")
            self.hand.run(0.2)
            self.assertEqual(self.fork.next().held_object, "")
            self.assertEqual(list(self.heights()), ["brick"])
            self.assertIn("removed box", self.call("undo").message)
            self.hand.run(1.0)
            self.assertAlmostEqual(self.heights()["box"], 0.02, delta=1e-4)  # nothing holds it now
            self.call("load_scene", path)
        self.assertEqual(sorted(self.heights()), ["box", "brick"])
        self.hand.pressed = False
        self.hand.run(1.0)
        for name, pose in before.items():
            now = next(o.pose for o in self.objects.next().objects if o.name == name)
            self.assertAlmostEqual(now.position.x, pose.position.x, delta=2e-3)
            self.assertAlmostEqual(now.position.y, pose.position.y, delta=2e-3)
        self.assertIn("since the scene was loaded", self.refused("undo"))

    def test_bad_calls_change_nothing(self):
        self.lift()
        before = self.fork.next()
        for service, arguments, words in [
            ("set_stiffness", (NAN, 0.0, 0.0, 0), ("stretch", "nan")),
            ("set_stiffness", (0.0, -1.0, 0.0, 0), ("bend", "-1")),
            ("set_stiffness", (0.0, 0.0, math.inf, 0), ("torsion", "inf")),
            ("set_damping", (0.0, 11.0, 0.0, "", 0), ("bend", "11")),
            ("set_damping", (NAN, 1.0, 1.0, "", 0), ("stretch", "nan")),
            ("set_integrator", ("magic", 0.0, 0.0), ("magic", "exponential")),
            ("set_integrator", ("rk4", -1.0, 0.0), ("step", "-1")),
            ("set_integrator", ("rk4", NAN, 0.0), ("step", "nan")),
            ("set_integrator", ("rk4", 2.0, 0.0), ("step", "2")),
            ("set_integrator", ("rk4", 0.0, -1e-3), ("tolerance", "-0.001")),
            ("set_integrator", ("rk4", 0.0, 1.0), ("tolerance", "0.1")),
            ("set_integrator", ("rk4", 0.0, NAN), ("tolerance", "nan")),
            ("load_scene", ("/nowhere/to/be/found.urdf",), ("/nowhere/to/be/found.urdf",)),
            ("load_scene", ("package://no_such_package/a.urdf",), ("no_such_package",)),
            ("load_scene", ("package://spring_workbench/package.xml",), ("package.xml",)),
            ("edit_object", ("paint", "box", "", Pose(), 0.0, 0.0), ("action", "paint", "friction")),
            ("edit_object", ("mass", "bin", "", Pose(), 1.0, 0.0), ("name", "bin", "box")),
            ("edit_object", ("mass", "box", "", Pose(), NAN, 0.0), ("mass", "nan")),
            ("edit_object", ("friction", "box", "", Pose(), 0.0, -1.0), ("friction", "-1")),
            ("edit_object", ("move", "box", "", Pose(), 0.0, 0.0), ("pose",)),
            ("edit_object", ("move", "box", "", UPRIGHT, 0.0, 0.0), ("name: box is held or pushed; release it first",)),
            ("edit_object", ("add", "box", BRICK, UPRIGHT, 0.0, 0.0), ("name", "box")),
            ("edit_object", ("add", "brick", BRICK, UNDER, 0.0, 0.0), ("brick would overlap the workbench",)),
            ("edit_object", ("add", "brick", "/etc/hostname", UPRIGHT, 0.0, 0.0), ("urdf", "/etc/hostname")),
            ("save_scene", ("/etc/scene.urdf",), ("path", "/etc/scene.urdf")),
            ("save_scene", ("scene.urdf",), ("path", "scene.urdf")),
        ]:
            line = self.refused(service, *arguments)
            for word in words:
                self.assertIn(word, line)
        after = self.fork.next()
        self.assertEqual(before.header.stamp, after.header.stamp)
        before.header.seq = after.header.seq = 0
        self.assertEqual(before, after)
        self.hand.run(0.2)
        self.assertEqual(self.fork.next().held_object, "box")

    def test_bad_transforms_are_rejected(self):
        self.lift()
        self.diagnostics.next()  # counts all samples of this hand
        count = lambda reason: int(
            diagnostic_values(self.diagnostics.messages, "tracker input").get("rejected: " + reason, "0")
        )
        reasons = {
            "not finite": stylus_transform(self.hand.now(), (NAN, 0, 0), DOWN),
            "not a unit quaternion": stylus_transform(self.hand.now(), (0, 0, 0), (0, 0, 0, 0)),
            "stamp not later": stylus_transform(self.hand.now() - rospy.Duration(0.1), (0, 0, 0), DOWN),
            "too old": stylus_transform(self.hand.now() - rospy.Duration(50), (0, 0, 0), DOWN),
            "from the future": stylus_transform(self.hand.now() + rospy.Duration(50), (0, 0, 0), DOWN),
            "unknown frame": stylus_transform(self.hand.now() + rospy.Duration(0.001), (0, 0, 0), DOWN),
        }
        reasons["unknown frame"].header.frame_id = "moon"
        before = {reason: count(reason) for reason in reasons}
        resting = self.box().pose.position
        for transform in reasons.values():
            self.hand.send(transform)
        for reason in reasons:
            wait_for(lambda: count(reason) == before[reason] + 1, "one more sample rejected: " + reason)
        for line in (r"stamp: [\d.]+ s old, more than max_age = 1 s", r"stamp: [\d.]+ s ahead of now, more than max"):
            wait_for(lambda: any(re.search(line, m.msg) for m in self.log.messages), line)
        self.hand.run(0.3)
        now = self.box().pose.position
        self.assertLess(math.dist((resting.x, resting.y, resting.z), (now.x, now.y, now.z)), 1e-6)

    def test_continues_at_rest_when_samples_stop(self):
        self.lift()
        stop = self.hand.now()
        self.hand.run(2.0, samples=False)
        state = self.objects.next(lambda m: (m.header.stamp - stop).to_sec() > 1.5, "the simulation to go on")
        self.assertTrue(state.objects[0].held)
        self.hand.run(0.5)
        self.assertEqual(self.fork.next().held_object, "box")

    def test_restarts_when_time_jumps_back(self):
        self.lift()
        self.hand.tick -= round(30.0 / Hand.STEP)
        self.hand.pressed = False
        self.hand.run(0.5)
        box = self.box()
        self.assertFalse(box.held)
        self.assertAlmostEqual(box.pose.position.z, 0.02, delta=1e-9)
        self.lift()
        self.assertGreater(self.box().pose.position.z, 0.2)

    def test_time_that_jumps_ahead_is_skipped(self):
        """A jump by an hour, which is not simulated: everything stays in place, at the new time."""
        self.lift()
        before, told = self.box().pose.position, len(self.steps.messages)
        self.hand.tick += round(3600.0 / Hand.STEP)
        self.hand.run(1.0)
        now = self.hand.now()
        wait_for(lambda: abs((self.objects.last.header.stamp - now).to_sec()) < 0.5, "the simulation to be there, too")
        self.assertTrue(self.box().held)
        after = self.box().pose.position
        self.assertLess(math.dist((before.x, before.y, before.z), (after.x, after.y, after.z)), 1e-3)
        self.assertLess(max(m.simulated_time for m in self.steps.messages[told:]), 60.0)

    def test_every_scene_loads(self):
        for scene, bodies in [("single_box", 1), ("mini_world", 7)]:
            self.call("load_scene", "package://spring_workbench/scenes/%s.urdf" % scene)
            self.hand.run(0.2)
            self.assertEqual(len(self.objects.next().objects), bodies)


if __name__ == "__main__":
    rospy.init_node("manipulation_test")
    rostest.rosrun("spring_workbench", "manipulation_test", Manipulation, sys.argv)
