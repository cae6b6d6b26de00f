#!/usr/bin/python3
"""Bags and motion files played through the nodes, with an object held, on a clock that runs ten times as fast: limits
on speed and wrench, what /diagnostics counts, and a bag looped for a hundred rounds."""
import glob
import math
import os
import sys
import tempfile
import threading
import time
import unittest
import xmlrpc.client

import rosgraph
import rospkg
import rospy
import rostest
from rosgraph_msgs.msg import Clock
from std_srvs.srv import SetBool
from spring_workbench.msg import ForkState, ObjectStates

from stack import Launched, Listener, diagnostic_values, diagnostics_listener, make_bag, wait_for

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
DATA = os.path.join(PACKAGE, "..", "shared", "data")
SCENE = "scene:=package://spring_workbench/scenes/single_box.urdf"
SPEED = 10
FASTEST, STRONGEST = 4.0, 250.0  # [m/s], [N]
ROUNDS = 100
BAG_START = 1000 * 10**9  # [ns], of make_bag


def has_nan(values):
    return not all(map(math.isfinite, values))


class Watch:
    """Looks at every state of the object and the fork."""

    def __init__(self):
        self.fastest = self.strongest = 0.0
        self.states, self.bad, self.held = 0, 0, 0
        self.listeners = [
            rospy.Subscriber("manipulation/objects", ObjectStates, self.on_objects, queue_size=1000),
            rospy.Subscriber("manipulation/fork", ForkState, self.on_fork, queue_size=1000),
        ]

    def on_objects(self, message):
        box = message.objects[0]
        p, q, v = box.pose.position, box.pose.orientation, box.twist.linear
        self.bad += has_nan((p.x, p.y, p.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z))
        self.fastest = max(self.fastest, math.hypot(v.x, v.y, v.z))
        self.states += 1
        self.held += box.held

    def on_fork(self, message):
        force = message.tip_wrench.force
        self.bad += has_nan((force.x, force.y, force.z))
        self.strongest = max(self.strongest, math.hypot(force.x, force.y, force.z))

    def end(self):
        for listener in self.listeners:
            listener.unregister()


class FastClock:
    """Publishes /clock, ten times as fast as the wall's."""

    def __enter__(self):
        self.publisher = rospy.Publisher("/clock", Clock, queue_size=10)
        self.running = True
        self.thread = threading.Thread(target=self.run)
        self.thread.start()
        return self

    def run(self):
        begin = time.monotonic()
        while self.running:
            self.publisher.publish(Clock(rospy.Time.from_sec(100.0 + SPEED * (time.monotonic() - begin))))
            time.sleep(0.001)

    def __exit__(self, *_):
        self.running = False
        self.thread.join()
        self.publisher.unregister()


class PlayedRecordings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.settings = os.path.join(folder.name, "settings.yaml")
        with open(self.settings, "w") as file:
            file.write(
                "contact: none\ngrasp: {object: box, tip_in_object: 0 0 0 1 0 0 0}\nstart: {follow: true}\n"
                "max_age: 5.0\n"
            )
        self.patient = os.path.join(folder.name, "patient.yaml")  # ten times as fast, an age grows as quickly
        with open(self.patient, "w") as file:
            file.write("max_age: 5.0\n")
        self.bag = os.path.join(folder.name, "hand.bag")
        rospy.set_param("/use_sim_time", True)

    def check(self, watch, name):
        watch.end()
        print(
            "%s: %d states, fastest %.2f m/s, strongest %.0f N" % (name, watch.states, watch.fastest, watch.strongest)
        )
        self.assertEqual(watch.bad, 0)
        self.assertGreater(watch.held, 100)
        self.assertLess(watch.fastest, FASTEST)
        self.assertLess(watch.strongest, STRONGEST)

    def test_every_motion_file_through_the_driver(self):
        files = sorted(glob.glob(DATA + "/motions/*.tum"))
        if not files:
            self.skipTest("no recordings in " + DATA)
        with FastClock():
            for path in files:
                with self.subTest(path=path):
                    watch, diagnostics = Watch(), diagnostics_listener()
                    with Launched(
                        "workbench.launch",
                        SCENE,
                        "settings:=" + self.settings,
                        "rviz:=false",
                        "input:=motion_file",
                        "motion:=" + path,
                        "pause:=30",
                    ):
                        wait_for(
                            lambda: diagnostic_values(diagnostics.messages, "source").get("state") == "over",
                            "the motion's end",
                            120.0,
                        )
                        values = wait_for(lambda: diagnostic_values(diagnostics.messages, "tracker input"), "input")
                    diagnostics.subscriber.unregister()
                    print({k: v for k, v in values.items() if v != "0"})
                    self.check(watch, os.path.basename(path))

    def test_every_bag(self):
        if not os.path.isdir(DATA + "/bags"):
            self.skipTest("no recordings in " + DATA)
        for name, parent, child, states in [
            ("evo_tf_example_lz4", "odom", "base_footprint", 450),
            ("rosbagjs_turtlesim_tf", "world", "turtle1", 1200),
        ]:
            with self.subTest(bag=name):
                watch = Watch()
                with Launched(
                    "playback.launch",
                    "bag:=%s/bags/%s.bag" % (DATA, name),
                    SCENE,
                    "speed:=%d" % SPEED,
                    "settings:=" + self.settings,
                    "rviz:=false",
                    "workbench_frame:=" + parent,
                    "stylus_frame:=" + child,
                ):
                    wait_for(lambda: watch.states > states, "the bag to be played")
                self.check(watch, name)

    def test_a_bag_without_a_stylus_is_told(self):
        if not os.path.isdir(DATA + "/bags"):
            self.skipTest("no recordings in " + DATA)
        diagnostics = diagnostics_listener()
        with Launched("playback.launch", "bag:=" + DATA + "/bags/evo_tf_example_lz4.bag", SCENE, "rviz:=false"):
            hint = wait_for(lambda: diagnostic_values(diagnostics.messages, "tracker input").get("hint"), "a hint")
        diagnostics.subscriber.unregister()
        self.assertIn("/tf", hint)

    def test_a_bag_with_nothing_to_play_ends_the_launch(self):
        if not os.path.isdir(DATA + "/bags"):
            self.skipTest("no recordings in " + DATA)
        for name in ["fuse_turtlebot3_odom_bz2", "rosbagjs_no-messages", "rosbagjs_not-a-bag"]:
            with self.subTest(bag=name):
                bag = "bag:=%s/bags/%s.bag" % (DATA, name)
                with Launched("playback.launch", bag, SCENE, "rviz:=false") as launched:
                    wait_for(lambda: launched.process.poll() is not None, "roslaunch to end")

    def test_a_hundred_rounds_are_the_same(self):
        make_bag(self.bag, speed=2.0)
        rounds = []  # stamp -> pose, each

        def on_objects(message):
            stamp = message.header.stamp.to_nsec()
            # Before the bag there is another clock; at its first sample the state shows only when a cycle falls there.
            if not BAG_START < stamp < BAG_START + 10**10:
                return
            if not rounds or (rounds[-1] and stamp < max(rounds[-1]) - 1000000000):
                rounds.append({})
            box = message.objects[0]
            p, q = box.pose.position, box.pose.orientation
            rounds[-1][stamp] = (p.x, p.y, p.z, q.x, q.y, q.z, q.w, box.held)

        memory = []
        subscriber = rospy.Subscriber("manipulation/objects", ObjectStates, on_objects, queue_size=10000)
        with Launched(
            "playback.launch",
            "bag:=" + self.bag,
            SCENE,
            "settings:=" + self.patient,
            "rviz:=false",
            "loop:=true",
            "speed:=%d" % SPEED,
        ):
            for goal in [20, 50, ROUNDS + 2]:
                wait_for(lambda: len(rounds) >= goal, "round %d" % goal, 300.0)
                memory.append(self.memory_of("/manipulation"))
                self.pause_player(0.5)
        subscriber.unregister()
        first = rounds[1]
        self.assertTrue(any(pose[7] for pose in first.values()))  # the box is held
        self.assertGreater(max(pose[2] for pose in first.values()), 0.15)
        # The bag lasts 2.28 s. What decides a step is the sample after it: the round ends before the last but one.
        self.assertGreater(max(first) - min(first), 2.22e9)
        worst = 0.0
        for one in rounds[1 : ROUNDS + 1]:
            self.assertEqual(set(one), set(first))
            for stamp, pose in one.items():
                self.assertEqual(pose[7], first[stamp][7])
                worst = max(worst, max(abs(a - b) for a, b in zip(first[stamp][:7], pose[:7])))
        print(
            "%d rounds of %d states, largest difference %.3g; memory %d kB, then %d kB"
            % (ROUNDS, len(first), worst, memory[0], memory[-1])
        )
        self.assertLess(worst, 1e-9)
        self.assertLess(memory[-1] - memory[0], 1024)

    def pause_player(self, seconds):
        pause = rospy.ServiceProxy("playback/pause_playback", SetBool)
        pause(True)
        time.sleep(seconds)  # of the wall's clock; the bag's stands
        pause(False)

    def memory_of(self, node):
        """Resident memory [kB]."""
        uri = rosgraph.Master("/test").lookupNode(node)
        pid = xmlrpc.client.ServerProxy(uri).getPid("/test")[2]
        with open("/proc/%d/status" % pid) as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


if __name__ == "__main__":
    rospy.init_node("played_recordings_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "played_recordings_test", PlayedRecordings, sys.argv)
