#!/usr/bin/python3
"""The tools of `manipulation` and its further styluses, by topics and services: scenes/single_box, hands on their own
clock."""
import math
import os
import subprocess
import sys
import tempfile
import unittest

import numpy
import rosgraph
import rospkg
import rospy
import rostest
from geometry_msgs.msg import TwistStamped, WrenchStamped
from sensor_msgs.msg import Joy
from spring_workbench.msg import ForkState, ObjectStates, ProbeReading
from spring_workbench.srv import Calibrate, Release, SelectTool, SetClutch, SetForkDamping, SetForkStiffness
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from stack import (
    DEADLINE,
    DOWN,
    Hand,
    Listener,
    diagnostic_values,
    diagnostics_listener,
    services_of_manipulation,
    stylus_transform,
    wait_for,
)

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
LENGTH, WEIGHT, FORCE_SCALE = 0.2, 9.81, 4.0
IN_BOX, LIFTED, AWAY = (0.02, 0.0, 0.02 + LENGTH), (0.02, 0.0, 0.30 + LENGTH), (0.02, 0.3, 0.30 + LENGTH)


class Hands(Hand):
    """The first stylus with its buttons, and further styluses at rest."""

    def __init__(self):
        super().__init__()
        self.next_tool = self.clutch = False
        self.further = {}  # number of a stylus -> its place
        self.pressing = set()  # numbers of those whose grasp button is down
        self.further_joy = {k: rospy.Publisher("stylus_%d/joy" % k, Joy, queue_size=100) for k in (2, 4)}

    def send(self, transform):
        transforms = [transform]
        for number, place in self.further.items():
            transforms.append(stylus_transform(transform.header.stamp, place, DOWN))
            transforms[-1].child_frame_id = "stylus_%d" % number
        self.tf.publish(TFMessage(transforms))

    def send_button(self):
        joy = Joy()
        joy.header.stamp = self.now()
        joy.buttons = [int(self.pressed), int(self.next_tool), int(self.clutch)]
        self.joy.publish(joy)
        for number in self.further:
            joy.buttons = [int(number in self.pressing), 0]
            self.further_joy[number].publish(joy)


class Tools(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.services = services_of_manipulation(
            {
                "select_tool": SelectTool,
                "set_stiffness": SetForkStiffness,
                "set_damping": SetForkDamping,
                "reset": Trigger,
                "calibrate": Calibrate,
                "release": Release,
                "clutch": SetClutch,
            }
        )
        cls.objects = Listener("manipulation/objects", ObjectStates)
        cls.fork = Listener("manipulation/fork", ForkState)
        cls.probe = Listener("manipulation/probe", ProbeReading)
        cls.shown_fork = Listener("manipulation/display/fork", ForkState)
        cls.fork_2 = Listener("manipulation/fork_2", ForkState)
        cls.wrench_2 = Listener("manipulation/wrench_2", WrenchStamped)
        cls.fork_4 = Listener("manipulation/fork_4", ForkState)
        cls.wrench_4 = Listener("manipulation/wrench_4", WrenchStamped)
        cls.probe_4 = Listener("manipulation/probe_4", ProbeReading)
        cls.wrench = Listener("manipulation/wrench", WrenchStamped)
        cls.tf = Listener("/tf", TFMessage)
        cls.diagnostics = diagnostics_listener()
        cls.hand = Hands()
        cls.hand.wait_for_node()
        for joy in cls.hand.further_joy.values():
            wait_for(lambda joy=joy: joy.get_num_connections() > 0, "the node to listen to " + joy.name)

    def setUp(self):
        self.hand.pressed = self.hand.next_tool = self.hand.clutch = False
        self.hand.further, self.hand.pressing, self.hand.position = {}, set(), AWAY
        self.hand.run(0.2)
        for stylus in [1, 2, 3, 4]:
            self.call("select_tool", "spring_fork", stylus)
        self.call("set_stiffness", 2000.0, 500.0, 5.0, 0)
        self.call("reset")
        self.hand.run(0.2)

    def call(self, service, *arguments):
        answer = self.services[service](*arguments)
        self.assertTrue(answer.success, answer.message)
        return answer

    def box(self):
        return self.objects.next().objects[0]

    def lift(self):
        self.hand.move(IN_BOX, DOWN, 0.5)
        self.hand.run(0.1)
        self.hand.pressed = True
        self.hand.run(0.2)
        self.hand.move(LIFTED, DOWN, 1.0)
        self.hand.run(2.0)
        self.assertEqual(self.fork.next().held_object, "box")

    def test_select_tool_while_holding_does_not_jump(self):
        self.lift()
        for tool in ["spring", "direct", "ray", "spring_fork"]:
            before = self.box().pose.position
            self.assertIn(tool, self.call("select_tool", tool, 0).message)
            self.assertEqual(self.fork.next().tool, tool)
            after = self.box().pose.position
            self.assertLess(math.dist((before.x, before.y, before.z), (after.x, after.y, after.z)), 1e-9)
            self.hand.run(0.5)
            self.assertEqual(self.fork.next().held_object, "box")
        self.assertIn("released", self.call("select_tool", "spring_probe", 1).message)
        self.hand.run(0.2)
        self.assertFalse(self.box().held)

    def test_bad_tools_are_refused(self):
        for arguments, words in [(("tongs", 1), ("tongs", "spring_probe")), (("spring", 5), ("stylus", "5"))]:
            answer = self.services["select_tool"](*arguments)
            self.assertFalse(answer.success)
            for word in words:
                self.assertIn(word, answer.message)
        self.assertEqual(self.fork.next().tool, "spring_fork")

    def test_second_button_takes_the_next_tool(self):
        for tool in ["spring_probe", "direct", "ray", "spring", "spring_fork"]:
            self.hand.next_tool = True
            self.hand.run(0.1)
            self.hand.next_tool = False
            self.hand.run(0.1)
            self.assertEqual(self.fork.next().tool, tool)

    def test_clutch_by_service_and_by_button(self):
        self.lift()
        place = lambda: (lambda p: (p.x, p.y, p.z))(self.box().pose.position)
        self.hand.run(4.0)
        for on, off in [
            (lambda: self.call("clutch", True, 1), lambda: self.call("clutch", False, 0)),
            (lambda: setattr(self.hand, "clutch", True), lambda: setattr(self.hand, "clutch", False)),
        ]:
            on()
            self.hand.run(0.2)
            before, start = place(), self.hand.position
            self.hand.move([start[0] + 0.3, start[1] - 0.4, start[2]], DOWN, 1.0)
            self.hand.run(0.2)  # what is committed is a sample behind
            self.assertLess(math.dist(before, place()), 1e-9)
            off()
            self.hand.run(0.2)
            self.hand.move([start[0] + 0.3, start[1] - 0.3, start[2]], DOWN, 1.0)
            self.hand.run(4.0)
            self.assertLess(math.dist((before[0], before[1] + 0.1, before[2]), place()), 1e-4)
        self.assertFalse(self.services["clutch"](True, 5).success)

    def test_stylus_of_calibrate_and_release(self):
        self.lift()
        for service in ["calibrate", "release"]:
            self.assertIn("held", self.services[service](2).message)
            self.assertTrue(self.box().held)
        self.call("calibrate", 1)
        self.call("release", 1)
        self.assertFalse(self.box().held)

    def test_scale_and_torque_wrench_in_virtual_and_real_units(self):
        self.lift()
        fork, wrench = self.fork.next(), self.wrench.next()
        self.assertEqual(fork.force_scale, FORCE_SCALE)
        self.assertAlmostEqual(fork.weight, 1.0, delta=1e-3)  # [vkg]
        self.assertAlmostEqual(fork.tip_wrench.force.z, WEIGHT, delta=0.01)
        self.assertAlmostEqual(wrench.wrench.force.z, WEIGHT / FORCE_SCALE, delta=0.05 * WEIGHT / FORCE_SCALE)
        self.assertLess(abs(fork.torque), 1e-3)  # held upright, the box does not twist it
        for averaged in (fork, self.shown_fork.next()):
            self.assertAlmostEqual(averaged.weight_mean, 1.0, delta=1e-3)
            self.assertLess(averaged.weight_uncertainty, 1e-3)
        before = self.box().pose.position.z
        self.call("calibrate")
        self.hand.run(2.0)
        fork = self.fork.next()
        gyration = math.sqrt((0.1**2 + 0.06**2 + 0.04**2) / 18.0)
        of_water = math.sqrt(0.4) * (3.0 / (4000.0 * math.pi)) ** (1.0 / 3.0)  # radius of gyration of a ball of 1 kg
        self.assertAlmostEqual(fork.length, 7.0 * math.sqrt(gyration * of_water), delta=1e-9)
        self.assertAlmostEqual(fork.stretch, 0.1 * fork.length, delta=1e-3 * fork.length)
        self.assertAlmostEqual(self.box().pose.position.z, before, delta=1e-5)

    def test_probe_presses_the_box_on_the_bench(self):
        self.call("select_tool", "spring_probe", 1)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        picture = os.path.join(folder.name, "curve.png")
        curve = subprocess.Popen([PACKAGE + "/scripts/probe_curve", picture], stdout=subprocess.PIPE, text=True)
        listeners = lambda: dict(rosgraph.Master("/test").getSystemState()[1]).get("/manipulation/probe", [])
        wait_for(lambda: any("probe_curve" in name for name in listeners()), "probe_curve to listen")
        self.hand.position = (0.02, 0.0, 0.4)
        self.hand.run(0.2)
        self.hand.move((0.02, 0.0, 0.04 + LENGTH + 0.005), DOWN, 0.5)
        self.hand.run(0.5)
        self.hand.move((0.02, 0.0, 0.04 + LENGTH - 0.02), DOWN, 2.0)
        self.hand.followed_by = (self.fork,)  # until it has pressed all the way, however slow the node is
        self.addCleanup(setattr, self.hand, "followed_by", ())
        self.hand.run(1.0)
        fork = self.fork.next()
        self.assertEqual((fork.touched, fork.held_object), ("box", ""))
        self.assertAlmostEqual(fork.stretch, -0.02, delta=1e-3)  # the box is rigid
        self.assertFalse(self.box().held)
        reading = self.probe.next()  # of the touch that went 20 mm deep
        self.assertEqual(reading.touched, "box")
        self.assertAlmostEqual(reading.force, 0.02 * fork.stretch_stiffness, delta=0.05 * 0.02 * fork.stretch_stiffness)
        self.assertTrue(reading.identified)
        self.assertGreater(reading.stiffness, 50 * fork.stretch_stiffness)  # the box is rigid
        self.assertGreater(fork.material_stiffness, 50 * fork.stretch_stiffness)
        self.assertEqual(len(reading.depths), len(reading.forces))
        self.assertAlmostEqual(reading.forces[-1], reading.force, delta=0.05 * reading.force)
        self.assertAlmostEqual(reading.depths[-1], 0.02, delta=1e-3)
        self.hand.move((0.02, 0.0, 0.4), DOWN, 1.0)
        self.hand.run(0.5)
        told = curve.communicate(timeout=DEADLINE)[0]
        self.assertEqual(curve.returncode, 0, told)
        self.assertRegex(told, r"^box: .*(N/m|rigid)")
        with open(picture, "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")

    def test_second_stylus_takes_the_object_over(self):
        self.lift()
        self.hand.further = {2: (-0.03, 0.0, LIFTED[2])}
        self.hand.run(0.3)
        self.hand.pressing = {2}
        self.hand.run(1.5)
        first, second = self.fork.next(), self.fork_2.next()
        self.assertEqual((first.held_object, second.held_object), ("box", "box"))
        self.assertAlmostEqual(first.tip_wrench.force.z + second.tip_wrench.force.z, WEIGHT, delta=0.01)
        rate = lambda: float(diagnostic_values(self.diagnostics.messages, "stylus 2").get("rate [Hz]", 0.0))
        wait_for(lambda: self.hand.run(0.1) or abs(rate() - 50.0) < 1.0, "the second stylus in /diagnostics")
        frames = {t.child_frame_id for m in self.tf.messages for t in m.transforms}
        self.assertLessEqual({"fork_handle", "fork_tip", "fork_handle_2", "fork_tip_2"}, frames)
        self.hand.pressed = False
        self.hand.run(1.5)
        self.assertEqual((self.fork.next().held_object, self.fork_2.next().held_object), ("", "box"))
        self.assertTrue(self.box().held)
        self.assertAlmostEqual(self.fork_2.next().weight, 1.0, delta=1e-3)
        felt = self.wrench_2.next()
        self.assertEqual(felt.header.frame_id, "fork_handle_2")
        self.assertAlmostEqual(felt.wrench.force.z, WEIGHT / FORCE_SCALE, delta=0.05 * WEIGHT / FORCE_SCALE)
        self.assertIn("box", self.call("release").message)

    def test_a_fourth_stylus_is_a_hand_like_the_first(self):
        """It takes the box over, with readings, frames and markers of its own, and touches it with its own probe."""
        markers = Listener("manipulation/markers", MarkerArray)
        self.addCleanup(markers.subscriber.unregister)
        self.lift()
        self.call("set_stiffness", 700.0, 300.0, 2.0, 4)
        self.hand.further = {4: (-0.03, 0.0, LIFTED[2])}
        self.hand.run(0.3)
        self.hand.pressing = {4}
        self.hand.run(0.5)
        self.hand.pressed = False
        self.hand.run(2.5)
        fork, felt = self.fork_4.next(), self.wrench_4.next()
        self.assertEqual((self.fork.next().held_object, fork.held_object), ("", "box"))
        self.assertEqual((fork.stretch_stiffness, self.fork.last.stretch_stiffness), (700.0, 2000.0))
        self.assertAlmostEqual(fork.weight, 1.0, delta=1e-3)
        self.assertAlmostEqual(fork.weight_mean, 1.0, delta=1e-3)
        self.assertEqual(felt.header.frame_id, "fork_handle_4")
        self.assertAlmostEqual(felt.wrench.force.z, WEIGHT / FORCE_SCALE, delta=0.05 * WEIGHT / FORCE_SCALE)
        frames = {t.child_frame_id for m in self.tf.messages for t in m.transforms}
        self.assertLessEqual({"fork_handle_4", "fork_tip_4"}, frames)
        drawn = {m.ns for m in wait_for(lambda: self.hand.run(0.1) or markers.last, "markers").markers}
        self.assertLessEqual({"fork_4", "force_4", "readout_4", "legend load_4"}, drawn)
        self.assertNotIn("fork_3", drawn)  # that stylus has sent nothing
        self.assertIn("box", self.call("release", 4).message)
        self.hand.further, self.hand.pressing = {}, set()
        self.call("reset")
        self.call("select_tool", "spring_probe", 4)
        self.hand.further = {4: (0.02, 0.0, 0.04 + LENGTH - 0.01)}
        self.hand.run(2.0)  # it is followed there at a bounded speed
        self.assertEqual((self.fork_4.next().touched, self.probe_4.next().touched), ("box", "box"))
        self.assertEqual(self.fork.next().tool, "spring_fork")

    def test_a_silent_stylus_delays_the_other_by_one_dropout(self):
        """What is committed for the machine of the first hand waits for the second one's samples for `dropout_after`,
        then goes on without it, and nothing is left out. What is displayed of the first hand does not wait."""
        dropout_after, late = 0.5, 0.5  # late: of the clock, for a message on a busy machine
        self.lift()
        self.hand.further = {2: (-0.03, 0.0, LIFTED[2])}
        self.hand.run(0.5)
        topics = [("wrench", WrenchStamped), ("tip_twist", TwistStamped), ("display/fork", ForkState)]
        arrived = {topic: [] for topic, _ in topics}
        note = lambda m, topic: arrived[topic].append((m.header.stamp.to_sec(), self.hand.now().to_sec()))
        listeners = [rospy.Subscriber("manipulation/" + t, kind, note, t, queue_size=1000) for t, kind in topics]
        wait_for(lambda: self.hand.run(0.1) or all(arrived.values()), "wrench, twist and display")
        begin = self.hand.now().to_sec()
        second, self.hand.further = self.hand.further, {}
        self.hand.run(4.0)
        back = self.hand.now().to_sec()
        self.hand.further = second
        self.hand.run(1.0)
        end = self.hand.now().to_sec()
        for listener, (topic, pairs) in zip(listeners, arrived.items()):
            wait_for(lambda: self.hand.run(0.1) or pairs[-1][0] > end, "the last " + topic)
            listener.unregister()
            lags = lambda since, until: [now - stamp for stamp, now in pairs if since < now < until]
            waited, silent, again = lags(begin, begin + 1.5), lags(begin + 1.5, back), lags(back, end)
            print("%s: waited %.2f s, then %.2f s, and %.2f s" % (topic, max(waited), max(silent), max(again)))
            sample = Hand.STEP * Hand.SAMPLE
            self.assertLess(max(silent + again), late)
            if topic == "display/fork":
                self.assertLess(max(waited), late)
                self.assertGreater(len(lags(begin, begin + dropout_after)), 0.5 * dropout_after / sample)
                continue
            self.assertLess(max(waited), dropout_after + late)
            sent = {round(t / sample) for t in numpy.arange(begin + sample, end - sample, sample)}
            self.assertLessEqual(sent, {round(stamp / sample) for stamp, _ in pairs})

    def test_each_hand_has_settings_of_its_own(self):
        """Both carry the box, each with its own springs. Setting the current values for both moves nothing."""
        self.lift()
        self.hand.further = {2: (-0.03, 0.0, LIFTED[2])}
        self.hand.run(0.3)
        self.hand.pressing = {2}
        self.hand.run(0.5)
        self.call("set_stiffness", 700.0, 300.0, 2.0, 2)
        springs = lambda fork: (fork.stretch_stiffness, fork.bend_stiffness, fork.torsion_stiffness)
        self.hand.move((LIFTED[0], LIFTED[1], LIFTED[2] - 0.003), DOWN, 0.3)  # both carry a share
        self.hand.run(6.0)
        self.assertEqual(springs(self.fork.next()), (2000.0, 500.0, 5.0))
        self.assertEqual(springs(self.fork_2.next()), (700.0, 300.0, 2.0))
        self.assertEqual((self.fork.last.held_object, self.fork_2.last.held_object), ("box", "box"))
        self.assertGreater(min(self.fork.last.stretch, self.fork_2.last.stretch), 1e-3)

        def numbers(pose):
            return [getattr(pose.position, a) for a in "xyz"] + [getattr(pose.orientation, a) for a in "xyzw"]

        before = numbers(self.box().pose)
        for stylus in (0, 1, 2):
            self.call("set_damping", 1.0, 1.0, 1.0, "", stylus)
            seen = len(self.objects.messages)
            self.hand.run(1.0)
            for message in self.objects.messages[seen:]:
                for a, b in zip(numbers(message.objects[0].pose), before):
                    self.assertAlmostEqual(a, b, delta=1e-9)
            self.assertEqual(springs(self.fork.next()), (2000.0, 500.0, 5.0))
            self.assertEqual(springs(self.fork_2.next()), (700.0, 300.0, 2.0))

    def test_both_restart_when_time_jumps_back(self):
        self.lift()
        self.hand.further, self.hand.pressing = {2: (-0.03, 0.0, LIFTED[2])}, {2}
        self.hand.run(0.5)
        self.hand.tick -= round(30.0 / Hand.STEP)
        self.hand.pressed, self.hand.pressing = False, set()
        self.hand.run(0.6)
        self.assertAlmostEqual(self.box().pose.position.z, 0.02, delta=1e-9)
        newest = self.fork_2.next(
            lambda m: abs((m.header.stamp - self.hand.now()).to_sec()) < 0.5, "the second stylus"
        ).handle
        self.assertAlmostEqual(newest.position.x, -0.03, delta=1e-9)


if __name__ == "__main__":
    rospy.init_node("tools_test")
    rostest.rosrun("spring_workbench", "tools_test", Tools, sys.argv)
