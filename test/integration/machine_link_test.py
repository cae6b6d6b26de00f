#!/usr/bin/python3
"""`manipulation` with a machine: publishes the twist of the tip, receives measurements of a force sensor;
scenes/single_box, a
hand and a sensor on their own clock."""
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import TwistStamped, Vector3, Wrench, WrenchStamped
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JoyFeedback, JoyFeedbackArray
from spring_workbench.msg import ForkState, ObjectStates
from std_srvs.srv import Trigger

from stack import DEADLINE, DOWN, Hand, Listener, diagnostic_values, diagnostics_listener, wait_for

LENGTH, WEIGHT, STIFFNESS, FORCE_SCALE = 0.2, 9.81, 2000.0, 2.0
IN_BOX, LIFTED = (0.0, 0.0, 0.02 + LENGTH), (0.0, 0.0, 0.30 + LENGTH)
ASIDE = (0.2, 0.1, 0.35 + LENGTH)


class Machine(Hand):
    """The hand, and if a force is given, a sensor that measures it at each sample of the hand."""

    def __init__(self):
        super().__init__()
        self.measured, self.bad = None, None
        self.sensor = rospy.Publisher("manipulation/external_wrench", WrenchStamped, queue_size=100)

    def send_button(self):
        super().send_button()
        for wrench in [self.measured, self.bad]:
            if wrench:
                wrench.header.stamp = self.now()
                self.sensor.publish(wrench)


def wrench_of(force, frame="world"):
    message = WrenchStamped()
    message.header.frame_id = frame
    message.wrench = Wrench(Vector3(*force), Vector3())
    return message


class MachineLink(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_service("manipulation/reset", DEADLINE)
        cls.reset = rospy.ServiceProxy("manipulation/reset", Trigger)
        cls.fork = Listener("manipulation/fork", ForkState)
        cls.objects = Listener("manipulation/objects", ObjectStates)
        cls.twist = Listener("manipulation/tip_twist", TwistStamped)
        cls.feedback = Listener("manipulation/joy_feedback", JoyFeedbackArray)
        cls.log = Listener("/rosout", Log)
        cls.diagnostics = diagnostics_listener()
        cls.hand = Machine()
        cls.hand.followed_by = (cls.fork, cls.objects)
        cls.hand.wait_for_node()
        wait_for(lambda: cls.hand.sensor.get_num_connections() > 0, "the node to listen to ~external_wrench")

    def setUp(self):
        self.hand.pressed, self.hand.measured, self.hand.bad = False, None, None
        self.hand.position = LIFTED
        self.hand.run(0.3)
        self.assertTrue(self.reset().success)
        self.hand.run(0.2)
        self.hand.move(IN_BOX, DOWN, 0.5)
        self.hand.run(0.1)
        self.hand.pressed = True
        self.hand.run(0.2)
        self.hand.move(LIFTED, DOWN, 1.0)
        self.hand.run(2.0)
        self.assertEqual(self.fork.last.held_object, "box")
        self.assertAlmostEqual(self.fork.last.stretch, WEIGHT / STIFFNESS, delta=1e-5)

    def values(self):
        return diagnostic_values(self.diagnostics.messages, "external wrench")

    def test_twist_is_the_derivative_of_the_tips_pose(self):
        forks, twists = len(self.fork.messages), len(self.twist.messages)
        self.hand.move(ASIDE, DOWN, 1.5)
        tips = {m.header.stamp.to_nsec(): m.tip.position for m in self.fork.messages[forks:]}
        stamps = sorted(tips)
        found, fastest = 0, 0.0
        for message in self.twist.messages[twists:]:
            self.assertEqual(message.header.frame_id, "world")
            stamp = message.header.stamp.to_nsec()
            if stamp not in tips or stamp in (stamps[0], stamps[-1]):
                continue
            i = stamps.index(stamp)
            before, after, dt = tips[stamps[i - 1]], tips[stamps[i + 1]], (stamps[i + 1] - stamps[i - 1]) * 1e-9
            if dt > 0.05:
                continue
            v = message.twist.linear
            for axis in "xyz":
                expected = (getattr(after, axis) - getattr(before, axis)) / dt
                self.assertAlmostEqual(getattr(v, axis), expected, delta=0.02)
            found += 1
            fastest = max(fastest, abs(v.x))
        self.assertGreater(found, 20)
        self.assertGreater(fastest, 0.15)

    def test_the_weight_upwards_takes_the_load_off_the_fork(self):
        for frame, up in [("world", 1.0), ("fork_tip", -1.0)]:  # the tip points down
            self.hand.measured = wrench_of((0.0, 0.0, up * WEIGHT / FORCE_SCALE), frame)
            self.hand.run(2.0)
            self.assertAlmostEqual(self.fork.last.stretch, 0.0, delta=1e-5)
            self.assertAlmostEqual(self.fork.last.tip_wrench.force.z, 0.0, delta=0.02)

    def test_the_watchdog_ends_it_and_counts(self):
        self.hand.measured = wrench_of((0.0, 0.0, WEIGHT / FORCE_SCALE))
        self.hand.run(1.0)
        before = int(self.values().get("timeouts", 0))
        self.hand.measured = None
        self.hand.run(2.0)
        self.assertAlmostEqual(self.fork.last.stretch, WEIGHT / STIFFNESS, delta=1e-5)
        wait_for(lambda: int(self.values().get("timeouts", 0)) == before + 1, "one more timeout in /diagnostics")

    def test_a_strike_on_the_bench_is_felt_and_ends(self):
        self.hand.run(0.5)
        at_rest = len(self.feedback.messages)
        self.hand.run(0.5)
        self.assertEqual(len(self.feedback.messages), at_rest)
        self.hand.move(IN_BOX, DOWN, 0.25)  # the box comes down on the bench
        self.hand.run(1.0)
        felt = [m.array for m in self.feedback.messages[at_rest:]]
        self.assertTrue(all(len(a) == 1 and a[0].type == JoyFeedback.TYPE_RUMBLE and a[0].id == 0 for a in felt))
        intensities = [a[0].intensity for a in felt]
        self.assertGreater(max(intensities), 0.3)
        self.assertLessEqual(max(intensities), 1.0)
        self.assertEqual(intensities[-1], 0.0)
        self.assertFalse(any(a == b == 0.0 for a, b in zip(intensities, intensities[1:])))

    def test_every_measurement_is_taken(self):
        self.hand.measured = wrench_of((0.0, 0.0, 1.0))
        self.hand.run(0.1)
        taken = lambda: int(self.values().get("messages", 0))
        wait_for(taken, "the first in /diagnostics")
        self.hand.measured.header.stamp = self.hand.now()
        before = len(self.diagnostics.messages)
        wait_for(lambda: len(self.diagnostics.messages) > before + 1, "the count")
        before = taken()
        for _ in range(90):
            self.hand.sensor.publish(self.hand.measured)
        wait_for(lambda: taken() >= before + 90, "all of them")

    def test_invalid_wrenches_are_reported_and_change_nothing(self):
        self.hand.measured = wrench_of((0.0, 0.0, WEIGHT / FORCE_SCALE))
        self.hand.run(2.0)
        begin = len(self.log.messages)
        for bad, reason, line in [
            (wrench_of((0.0, 0.0, 1.0), "tool0"), "unknown frame", "header.frame_id: invalid value 'tool0': expected "),
            (wrench_of((0.0, float("nan"), 0.0)), "invalid value", "force.y: invalid value 'nan': expected a number"),
            (wrench_of((2e5, 0.0, 0.0)), "invalid value", "force."),
        ]:
            before = int(self.values().get("rejected: " + reason, 0))
            self.hand.bad = bad
            self.hand.run(0.5)
            self.hand.bad = None
            self.assertAlmostEqual(self.fork.last.stretch, 0.0, delta=1e-5)
            counted = lambda: int(self.values().get("rejected: " + reason, 0)) >= before + 20
            wait_for(counted, "rejections in /diagnostics: " + reason)
            told = [m.msg for m in self.log.messages[begin:] if "external_wrench: " in m.msg]
            self.assertTrue(any("external_wrench: " + line in text for text in told), line)
            self.assertLess(len(told), 10)


if __name__ == "__main__":
    rospy.init_node("machine_link_test")
    rostest.rosrun("spring_workbench", "machine_link_test", MachineLink, sys.argv)
