#!/usr/bin/python3
"""Nodes that are interrupted while they work exit with status 0: no callback runs in destroyed objects, and no
exception escapes. Several pairs at a time, on a busy machine, each interrupted at a random moment."""
import os
import random
import signal
import subprocess
import sys
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from spring_workbench.msg import ObjectStates

from stack import DEADLINE, Listener, wait_for

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
SCENE = os.path.join(PACKAGE, "scenes", "single_box.urdf")
MOTION = os.path.join(PACKAGE, "config", "mini_world_demo.yaml")
ROUNDS, PAIRS = 6, 3


def start(bench, node, *parameters):
    command = roslib.packages.find_node("spring_workbench", node)
    return subprocess.Popen([*command, "__ns:=" + bench, *parameters])


class EndedNodes(unittest.TestCase):
    def setUp(self):
        for _ in range(os.cpu_count()):
            busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
            self.addCleanup(busy.wait)
            self.addCleanup(busy.kill)

    def test_all_end_in_order(self):
        r = random.Random(1)
        for _ in range(ROUNDS):
            benches = ["/bench_%d" % i for i in range(PAIRS)]
            listeners = [Listener(bench + "/manipulation/objects", ObjectStates) for bench in benches]
            nodes = []
            for i, bench in enumerate(benches):
                stylus = "stylus_of_%d" % i
                nodes.append(start(bench, "manipulation", "_scene:=" + SCENE, "_stylus_frame:=" + stylus))
                hand = ["_source:=scripted", "_file:=" + MOTION, "_loop:=true", "_stylus_frame:=" + stylus]
                nodes.append(start(bench, "tracker_driver", *hand))
            for bench, listener in zip(benches, listeners):
                key, count = bench + "/manipulation/resume", r.randint(1, 120)
                wait_for(lambda: rospy.has_param(key), "a checkpoint of " + bench)
                seen = len(listener.messages)
                wait_for(lambda: len(listener.messages) > seen + count, "states of " + bench)
            for node in r.sample(nodes, len(nodes)):
                node.send_signal(signal.SIGINT)
            self.assertEqual([node.wait(DEADLINE) for node in nodes], [0] * len(nodes))
            for listener in listeners:
                listener.subscriber.unregister()


if __name__ == "__main__":
    rospy.init_node("ended_nodes_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "ended_nodes_test", EndedNodes, sys.argv)
