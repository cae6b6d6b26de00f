#!/usr/bin/python3
"""Nodes that are started with invalid input: one line that names it, and exit status 2."""
import math
import subprocess
import sys
import tempfile
import unittest

import rosgraph
import roslib.packages
import rospkg
import rostest

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
SCENE = PACKAGE + "/scenes/single_box.urdf"
MOTION = PACKAGE + "/test/integration/data/slide.tum"


def file_with(text, ending):
    file = tempfile.NamedTemporaryFile("w", suffix=ending, delete=False)
    file.write(text)
    file.close()
    return file.name


class BadStart(unittest.TestCase):
    def start(self, node, parameters):
        """Starts the node with private parameters; returns its exit status and output."""
        master = rosgraph.Master("/bad_start_test")
        name = "/" + node + "_refused"
        master.setParam(name, parameters)
        try:
            done = subprocess.run(
                roslib.packages.find_node("spring_workbench", node) + ["__name:=" + name[1:]],
                timeout=60,
                text=True,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
            )
        finally:
            master.deleteParam(name)
        return done.returncode, [line for line in done.stdout.splitlines() if line.strip()]

    def check(self, node, cases):
        for parameters, words in cases:
            with self.subTest(parameters=parameters):
                status, lines = self.start(node, parameters)
                self.assertEqual(status, 2, lines)
                self.assertEqual(len(lines), 1, lines)
                for word in words:
                    self.assertIn(word, lines[0])

    def test_manipulation(self):
        broken = file_with("<robot name='a'><link name='b'></robot>", ".urdf")
        self.check(
            "manipulation",
            [
                ({"rate": 100}, ["missing required key scene: "]),
                ({"scene": "/nowhere/a.urdf"}, ["/nowhere/a.urdf"]),
                ({"scene": broken}, [broken]),
                ({"scene": SCENE, "scene_file": "a"}, ["scene_file", "unknown"]),
                ({"scene": SCENE, "rate": "fast"}, ["rate", "fast"]),
                ({"scene": SCENE, "fork": {"stiffness": {"bend": math.nan}}}, ["fork.stiffness.bend", "nan"]),
                ({"scene": SCENE, "fork": {"stiffness": {"bend": -5.0}}}, ["fork.stiffness.bend", "-5"]),
                ({"scene": SCENE, "fork": 3}, ["fork: expected a map"]),
                ({"scene": SCENE, "grasp": {"object": "teapot"}}, ["grasp.object", "teapot"]),
            ],
        )

    def test_tracker_driver(self):
        broken = file_with("0 0 0 0 0 0 0 1\n0.1 0 0 zero 0 0 0 1\n", ".tum")
        no_waypoints = file_with("rate: 50\nwaypoints: []\n", ".yaml")
        self.check(
            "tracker_driver",
            [
                ({}, ["file"]),
                ({"file": "/nowhere/a.tum"}, ["/nowhere/a.tum"]),
                ({"file": broken}, [broken + ":2", "zero"]),
                ({"file": broken, "source": "scripted"}, [broken + ":2", "zero"]),
                ({"file": no_waypoints, "source": "scripted"}, [no_waypoints, "waypoints: expected"]),
                ({"file": no_waypoints}, [no_waypoints, "waypoints: expected"]),
                ({"file": MOTION, "source": "mice"}, ["source", "mice", "mouse, joy, fastrak"]),
                ({"file": MOTION, "speed": -1.0}, ["speed", "-1"]),
                ({"file": "package://no_such_package/a.tum"}, ["no_such_package"]),
            ],
        )


if __name__ == "__main__":
    rostest.rosrun("spring_workbench", "bad_start_test", BadStart, sys.argv)
