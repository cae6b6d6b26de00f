#!/usr/bin/python3
"""The clocks of tracker_driver and manipulation are set, together and separately, the host is suspended and the
processes are stopped, while an object is held and after it was put down elsewhere: it does not move, the hand is
followed again within half a second, and exactly one line says so. Then a second node sends the same stylus, and the
tracker's frame is moved.
STANDSTILL: how long the processes are stopped [s]."""
import contextlib
import math
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Joy
from spring_workbench.msg import ForkState, ObjectStates
from tf2_msgs.msg import TFMessage

from stack import DOWN, Listener, diagnostic_values, diagnostics_listener, stylus_transform, wait_for

SCENE = os.path.join(rospkg.RosPack().get_path("spring_workbench"), "scenes", "single_box.urdf")
STANDSTILL = float(os.environ.get("STANDSTILL", "7"))  # [s]
STEPS = [0.3, -0.3, 3.0, -3.0, 3600.0, -3600.0]
SUSPENDS = [7.0, 60.0]  # [s]; the wall clock counts them, the steady clock does not


def find(name):
    return roslib.packages.find_node("spring_workbench", name)[0]


class Shifted:
    """A node with its own clock."""

    def __init__(self, folder, node, *arguments):
        self.path = os.path.join(folder, node)
        self.shift = 0.0
        self.set(0.0)
        environment = dict(os.environ, LD_PRELOAD=find("libshifted_clock.so"), SHIFTED_CLOCK=self.path)
        self.process = subprocess.Popen([find(node), *arguments], env=environment)

    def set(self, by):
        self.shift += by
        with open(self.path, "r+b" if os.path.exists(self.path) else "wb") as file:
            file.write(struct.pack("q", round(1e9 * self.shift)))

    def now(self):
        return time.time() + self.shift

    def end(self):
        self.process.kill()
        self.process.wait()


def velocity(state):
    return (state.twist.linear.x, state.twist.linear.y, state.twist.linear.z)


def tip_force(fork):
    force = fork.tip_wrench.force
    return math.hypot(force.x, force.y, force.z)


class Clocks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        driver = ["_source:=joy", "_start:=0 0 0.22 1 0 0 0", "joy:=pad"]
        cls.driver = Shifted(folder.name, "tracker_driver", *driver)
        cls.addClassCleanup(cls.driver.end)
        cls.node = Shifted(folder.name, "manipulation", "_scene:=" + SCENE)
        cls.addClassCleanup(cls.node.end)
        cls.came = []  # arrival times of stylus samples, by a clock that is never set
        cls.tf = rospy.Subscriber("/tf", TFMessage, cls.on_transforms, queue_size=1000)
        cls.objects = Listener("manipulation/objects", ObjectStates)
        cls.diagnostics = diagnostics_listener()
        cls.log = Listener("/rosout", Log)
        cls.pad = rospy.Publisher("pad", Joy, queue_size=10, latch=True)
        cls.push(0.0, 0)
        wait_for(lambda: cls.came and cls.objects.last, "the stylus and the box")

    @classmethod
    def push(cls, speed, grasp, axis="z"):
        axes = [speed if axis == of else 0.0 for of in "xyz"] + [0.0] * 3
        cls.pad.publish(Joy(axes=axes, buttons=[grasp, 0]))

    def hold(self):
        """The hand holds the box, lifted, and rests."""
        box = lambda: self.objects.last.objects[0]
        if not box().held:
            self.push(0.0, 1)
            wait_for(lambda: box().held, "the box to be held")
            wait_for(lambda: self.push(1.0, 1) or box().pose.position.z > 0.1, "the box to be lifted")
            self.push(0.0, 1)
        wait_for(lambda: abs(box().twist.linear.z) < 1e-5, "the box to rest")

    def put_down(self):
        """The hand holds the box, carries it away from its start, puts it down and rests in it."""
        box = lambda: self.objects.last.objects[0]
        start = self.newest().pose.position
        self.hold()
        for axis, speed, there in (
            ("x", 1.0, lambda: box().pose.position.x > start.x + 0.1),
            ("z", -1.0, lambda: box().pose.position.z < start.z + 0.005),
        ):
            wait_for(lambda: self.push(speed, 1, axis) or there(), "the box to be carried along " + axis)
            self.push(0.0, 1)
            wait_for(lambda: max(map(abs, velocity(box()))) < 1e-3, "the hand to rest")
        self.push(0.0, 0)
        wait_for(lambda: not box().held and not any(velocity(box())), "the box to lie there")
        self.assertGreater(self.newest().pose.position.x, start.x + 0.1)

    @classmethod
    def on_transforms(cls, message):
        if any(t.child_frame_id == "stylus" for t in message.transforms):
            cls.came.append(time.monotonic())

    def count(self, name):
        return float(diagnostic_values(self.diagnostics.messages, "tracker input").get(name, 0.0))

    def newest(self):
        """The next published state of the box."""
        seen = len(self.objects.messages)
        wait_for(lambda: len(self.objects.messages) > seen, "a state")
        return self.objects.last.objects[0]

    def check_one_warning(self, fault, what, says):
        """One line of all nodes says what happened."""
        told = len(self.log.messages)
        gap, back = self.check(fault, what)
        wait_for(lambda: self.warnings(told), "a warning")
        self.assertEqual(len(self.warnings(told)), 1, self.warnings(told))
        self.assertIn("/manipulation: ", self.warnings(told)[0])
        self.assertIn(says, self.warnings(told)[0])
        self.assertLess(back, 0.5)
        return gap

    def warnings(self, since):
        return [m.name + ": " + m.msg for m in self.log.messages[since:] if m.level >= Log.WARN]

    @contextlib.contextmanager
    def no_other_warning(self):
        """The number of warnings since the beginning is that of the faults, even after the next diagnostics."""
        told, faults = len(self.log.messages), []
        yield lambda *fault: faults.append(fault) or self.check_one_warning(*fault)
        said = len(self.diagnostics.messages)
        wait_for(lambda: len(self.diagnostics.messages) > said + 4, "two diagnostics of each node")
        self.assertEqual(len(self.warnings(told)), len(faults), self.warnings(told))

    def check(self, fault, what):
        before, told = self.newest(), len(self.log.messages)
        seen, begin = len(self.objects.messages), time.monotonic()
        fault()
        end = time.monotonic()
        lag = lambda: abs(self.node.now() - self.objects.last.header.stamp.to_sec())
        wait_for(lambda: self.newest() and lag() < 0.2, "the box at the time that it is now")
        back = time.monotonic() - end
        time.sleep(0.5)
        place = lambda state: (state.pose.position.x, state.pose.position.y, state.pose.position.z)
        states = [m.objects[0] for m in self.objects.messages[seen:]]
        farthest = max(math.dist(place(before), place(state)) for state in states)
        print("%s: %.3g mm, back after %.2f s" % (what, 1e3 * farthest, back))
        for m in self.log.messages[told:]:
            if m.level >= Log.WARN:
                print("    %s: %s" % (m.name, m.msg))
        self.assertLess(farthest, 1e-3, what)
        self.assertTrue(all(s.held == before.held for s in states), what)
        self.assertGreater(len(states), 20, what)
        came = [t for t in self.came if t > begin - 0.2]
        gaps = [b - a for a, b in zip(came, came[1:])]
        return max(gaps), back

    def set_both(self, by, stopped):
        for node in stopped:
            node.process.send_signal(signal.SIGSTOP)
        time.sleep(0.1)  # no sample of the old time is under way, which would look like another clock's
        self.driver.set(by)
        self.node.set(by)
        for node in stopped:
            node.process.send_signal(signal.SIGCONT)

    def set_clocks(self):
        both, says = [self.driver, self.node], "clock"
        with self.no_other_warning() as check:
            gaps = [check(lambda: self.set_both(by, [self.driver]), "both by %g s" % by, says) for by in STEPS]
            gaps += [check(lambda: self.set_both(by, both), "suspended for %g s" % by, says) for by in SUSPENDS]
            for one in both:
                gaps += [check(lambda: one.set(by), "one by %g s" % by, says) for by in STEPS]
        self.assertLess(max(gaps), 0.5)

    def stop_processes(self):
        with self.no_other_warning() as check:
            for nodes, says in (
                ([self.node], "skipped"),
                ([self.driver], "the hand was lost"),
                ([self.driver, self.node], "skipped"),
            ):
                def stand():
                    for node in nodes:
                        node.process.send_signal(signal.SIGSTOP)
                    time.sleep(STANDSTILL)
                    for node in nodes:
                        node.process.send_signal(signal.SIGCONT)

                check(stand, "%d stood" % len(nodes), says)

    def test_at_rest(self):  # before the others, which hold the box
        self.put_down()
        self.set_clocks()
        self.stop_processes()
        self.assertFalse(self.newest().held)

    def test_clocks_are_set(self):
        self.hold()
        self.set_clocks()

    def test_processes_stand_still(self):
        self.hold()
        self.stop_processes()

    def test_two_senders(self):
        """The box that the hand of the first one holds is not pulled to the other's."""
        self.hold()
        forks = Listener("manipulation/fork", ForkState)
        self.addCleanup(forks.subscriber.unregister)
        wait_for(lambda: forks.last, "the fork")
        other = rospy.Publisher("/tf", TFMessage, queue_size=10)
        wait_for(lambda: other.get_num_connections() > 0, "the node to listen to another sender")

        def both():
            for _ in range(200):
                stamp = rospy.Time.from_sec(self.driver.now())
                other.publish(TFMessage([stylus_transform(stamp, (0.03, 0.0, 0.4), DOWN)]))
                time.sleep(0.005)

        seen = len(forks.messages)
        self.check(both, "two senders")
        strongest = max(map(tip_force, forks.messages[seen:]))
        print("two senders: at most %.3g N" % strongest)
        self.assertLess(strongest, 15.0)  # the box weighs 9.81 N
        self.assertGreater(self.count("rejected: another sender"), 100)

        def told():
            statuses = [s for m in self.diagnostics.messages for s in m.status if "tracker input" in s.name]
            both = "using /tracker_driver, ignoring /clocks_test"
            return any(s.level == s.ERROR and both in s.message for s in statuses)

        wait_for(told, "an error that names both")
        other.unregister()

    def test_the_tracker_is_moved(self):
        self.hold()
        forks = Listener("manipulation/fork", ForkState)
        wait_for(lambda: forks.last, "the fork")
        before = self.newest().pose.position.x
        seen = len(self.objects.messages)
        place = TransformStamped()
        place.header.frame_id, place.child_frame_id = "world", "workbench"
        place.transform.translation.x, place.transform.rotation.w = 0.5, 1.0
        publisher = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        publisher.publish(TFMessage([place]))
        wait_for(lambda: abs(self.newest().pose.position.x - before - 0.5) < 1e-5, "the box to be there, too")
        speed = lambda m: math.hypot(m.objects[0].twist.linear.x, m.objects[0].twist.linear.z)
        strongest = max(map(tip_force, forks.messages))
        fastest = max(map(speed, self.objects.messages[seen:]))
        print("moved by 0.5 m: at most %.3g N and %.3g m/s" % (strongest, fastest))
        self.assertLess(strongest, 30.0)
        self.assertLess(fastest, 1.5)
        wait_for(lambda: self.count("moves of the tracker's frame") == 1.0, "/diagnostics to say so")


if __name__ == "__main__":
    rospy.init_node("clocks_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "clocks_test", Clocks, sys.argv)
