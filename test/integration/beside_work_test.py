#!/usr/bin/python3
"""Work next to the hand: loading, editing and undoing in a scene of large meshes does not disturb the hand; steps that
take too long lose nothing; the loop has a real-time priority, or reports once why not."""
import contextlib
import math
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np
import roslib.packages
import rospkg
import rospy
import rostest
from sensor_msgs.msg import Joy
from spring_workbench.msg import ObjectStates, StepReport
from spring_workbench.srv import EditObject, LoadScene, SetForkStiffness, SetIntegrator
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from stack import DEADLINE, DOWN, Listener, diagnostic_values, diagnostics_listener, stylus_transform, wait_for

SCENE = os.path.join(rospkg.RosPack().get_path("spring_workbench"), "scenes", "single_box.urdf")
MANIPULATION = roslib.packages.find_node("spring_workbench", "manipulation")
PERIOD = 0.01  # [s] of the samples
PRIORITY = 7
BALLS, RINGS = 6, 247  # a ball has 244,036 triangles: four times the square
DROPOUT = 50  # samples in the silence after which a hand rests, 0.5 s by default
LINK = """<link name="ball_%d"><inertial><mass value="1"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0"
 iyz="0"/></inertial><collision><geometry><mesh filename="ball_%d.stl"/></geometry></collision></link>
<joint name="to_ball_%d" type="floating"><parent link="world"/><child link="ball_%d"/><origin xyz="%g 0.3 %g"/>
</joint>"""


def write_ball(path, radius):
    """Writes a sphere as a binary STL file."""
    polar, around = np.meshgrid(np.arange(RINGS + 1) * np.pi / RINGS, np.arange(2 * RINGS + 1) * np.pi / RINGS)
    corners = radius * np.array([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)]).T
    a, b, c, d = corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]
    triangles = np.zeros(4 * RINGS**2, [("normal", "<3f4"), ("corners", "<9f4"), ("attributes", "<u2")])
    triangles["corners"] = np.concatenate([np.stack(t, 2).reshape(-1, 9) for t in ((a, b, c), (a, c, d))])
    with open(path, "wb") as file:
        file.write(b" " * 80 + np.uint32(len(triangles)).tobytes() + triangles.tobytes())


def write_balls(folder):
    """Writes a scene of balls that stand on the bench; returns its path."""
    links = ""
    for i in range(BALLS):
        radius = 0.05 + 0.001 * i
        write_ball("%s/ball_%d.stl" % (folder, i), radius)
        links += LINK % (i, i, i, i, 0.2 * i - 0.3, radius)
    path = folder + "/balls.urdf"
    with open(path, "w") as file:
        file.write('<robot name="balls"><link name="world"/>%s</robot>' % links)
    return path


@contextlib.contextmanager
def node(before=(), **options):
    process = subprocess.Popen([*before, *MANIPULATION, "_scene:=" + SCENE], **options)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=DEADLINE)


def real_time_priority(pid):
    """The highest real-time priority of the node's threads, according to the kernel."""
    found = []
    for task in os.listdir("/proc/%d/task" % pid):
        with open("/proc/%d/task/%s/stat" % (pid, task)) as file:
            found.append(int(file.read().rsplit(")", 1)[1].split()[37]))
    return max(found)


class Hand:
    """A hand on the wall clock: it moves to its `goal` at SPEED and keeps its button `pressed` until it ends."""

    SPEED = 0.4  # [m/s]

    def __init__(self):
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.joy = rospy.Publisher("stylus/joy", Joy, queue_size=100)
        self.position = self.goal = (0.03, 0.0, 0.4)
        self.pressed, self.ends = False, threading.Event()
        self.sent = 0  # samples
        self.thread = threading.Thread(target=self.run)

    def __enter__(self):
        wait_for(lambda: self.tf.get_num_connections() and self.joy.get_num_connections(), "the node to listen")
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.ends.set()
        self.thread.join()

    def run(self):
        while not self.ends.wait(PERIOD):
            left = math.dist(self.position, self.goal)
            share = min(1.0, self.SPEED * PERIOD / left) if left > 0.0 else 0.0
            self.position = tuple(a + share * (b - a) for a, b in zip(self.position, self.goal))
            now = rospy.Time.from_sec(time.time())
            self.sent += 1
            self.tf.publish(TFMessage([stylus_transform(now, self.position, DOWN)]))
            joy = Joy(buttons=[int(self.pressed)])
            joy.header.stamp = now
            self.joy.publish(joy)

    def move(self, goal):
        self.goal = goal
        wait_for(lambda: self.position == goal, "the hand to arrive")


class BesideWork(unittest.TestCase):
    def setUp(self):
        self.diagnostics = diagnostics_listener()
        self.addCleanup(self.diagnostics.subscriber.unregister)
        self.shown = Listener("manipulation/display/objects", ObjectStates)
        self.addCleanup(self.shown.subscriber.unregister)

    def give(self, parameter, value):
        rospy.set_param("manipulation/" + parameter, value)
        self.addCleanup(rospy.delete_param, "manipulation/" + parameter)

    def test_a_large_scene_is_loaded_and_edited(self):
        """No gap in what is shown and committed is as long as a dropout while a large scene is made again and again."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = write_balls(folder.name)
        self.give("scene_roots", [folder.name])
        arrivals = {"display/objects": [], "objects": []}  # samples sent before each message
        with node(), Hand() as hand:
            for topic, sent in arrivals.items():
                note = lambda _, sent=sent: sent.append(hand.sent)
                subscriber = rospy.Subscriber("manipulation/" + topic, ObjectStates, note, queue_size=1000)
                self.addCleanup(subscriber.unregister)
            rospy.wait_for_service("manipulation/load_scene", DEADLINE)

            def some_more():
                enough = [len(sent) + 20 for sent in arrivals.values()]
                wait_for(lambda: all(len(sent) > n for sent, n in zip(arrivals.values(), enough)), "more messages")

            def expect_no_gap(what, change=lambda: None):
                """Returns the number of samples during the change."""
                some_more()
                seen, begin = [len(sent) for sent in arrivals.values()], hand.sent
                answer = change()
                self.assertTrue(answer is None or answer.success, answer)
                took = hand.sent - begin
                some_more()
                longest = [max(np.diff(sent[n - 1 :])) for sent, n in zip(arrivals.values(), seen)]
                print("%s took %d samples; longest gaps: shown %d, committed %d" % (what, took, *longest))
                self.assertLess(max(longest), DROPOUT, what)
                return took

            expect_no_gap("nothing", some_more)
            call = lambda service, kind, **request: (
                lambda: rospy.ServiceProxy("manipulation/" + service, kind)(**request)
            )
            edit = dict(action="mass", name="ball_0", mass=2.0)
            for what, change in (
                ("load_scene", call("load_scene", LoadScene, scene=path)),
                ("edit_object", call("edit_object", EditObject, **edit)),
                ("undo", call("undo", Trigger)),
            ):
                self.assertGreater(expect_no_gap(what, change), DROPOUT)  # it takes a while
            self.assertEqual(len(self.shown.last.objects), BALLS)
            self.diagnostics.next()
            self.diagnostics.next()
            said = diagnostic_values(self.diagnostics.messages, "tracker input")
            self.assertNotIn("rejected: too old", said)
            self.assertNotIn("rejected: the loop is stalled", said)

    def test_steps_that_take_too_long_lose_nothing(self):
        """Steps of 1 µs while holding: the answer says that they take longer, calls are answered, it is reported that
        the simulation is behind, and the box is still held, and followed, when steps are long again."""
        steps = Listener("manipulation/steps", StepReport)
        self.addCleanup(steps.subscriber.unregister)
        box = lambda: self.shown.next().objects[0]
        took = []

        def call(service, kind, *arguments):
            begin = time.monotonic()
            answer = rospy.ServiceProxy("manipulation/" + service, kind)(*arguments)
            took.append(time.monotonic() - begin)
            self.assertTrue(answer.success, answer.message)
            return answer

        with node(), Hand() as hand:
            rospy.wait_for_service("manipulation/set_integrator", DEADLINE)
            hand.move((0.03, 0.0, 0.22))
            wait_for(lambda: box().highlighted, "the tip to be in the box")
            hand.pressed = True
            wait_for(lambda: box().held, "the box to be held")
            hand.move((0.03, 0.0, 0.4))
            message = call("set_integrator", SetIntegrator, "rk4", 1e-6, 0.0).message
            self.assertGreater(float(re.search(r"a step takes (\S+) ms now: slower than real time", message)[1]), 1e-3)
            told, shown = len(steps.messages), len(self.shown.messages)
            for k in range(8):
                hand.move((0.03, 0.02 * (k % 2), 0.4))
                call("set_stiffness", SetForkStiffness, 2000.0, 500.0, 5.0, 0)
            wait_for(lambda: any(m.behind for m in steps.messages[told:]), "a report that it is behind")
            call("set_integrator", SetIntegrator, "exponential", 0.02, 0.0)
            print("the longest of %d calls took %.2f s" % (len(took), max(took)))
            self.assertLess(max(took), 2.0)
            self.assertTrue(all(m.objects[0].held for m in self.shown.messages[shown:]))
            hand.move((0.13, 0.0, 0.4))
            wait_for(lambda: abs(box().pose.position.x - 0.1) < 0.02, "the box to follow")
            self.assertTrue(box().held)

    def reported_priority(self):
        return wait_for(
            lambda: diagnostic_values(self.diagnostics.messages, "physics loop").get("real-time priority"), "the status"
        )

    def test_the_loop_has_the_reported_priority(self):
        self.give("realtime_priority", PRIORITY)
        with node() as process:
            self.assertIn(self.reported_priority(), ("0", str(PRIORITY)))  # 0: a host that permits none
            self.assertEqual(real_time_priority(process.pid), int(self.reported_priority()))

    def test_it_has_none_by_default(self):
        with node() as process:
            self.assertEqual(self.reported_priority(), "0")
            self.assertEqual(real_time_priority(process.pid), 0)

    def test_a_missing_permission_is_reported_once(self):
        before = ["setpriv", "--bounding-set=-sys_nice", "--inh-caps=-sys_nice"] if os.geteuid() == 0 else []
        self.give("realtime_priority", PRIORITY)
        forbid = lambda: resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))
        with tempfile.TemporaryFile("w+") as log:
            with node(before=before, stdout=log, stderr=log, preexec_fn=forbid) as process:
                self.assertEqual(self.reported_priority(), "0")
                self.assertEqual(real_time_priority(process.pid), 0)
                wait_for(lambda: len(self.shown.messages) > 5, "a node that works")
            log.seek(0)
            self.assertEqual(log.read().count("realtime_priority: %d is not permitted" % PRIORITY), 1)


if __name__ == "__main__":
    rospy.init_node("beside_work_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "beside_work_test", BesideWork, sys.argv)
