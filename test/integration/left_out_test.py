#!/usr/bin/python3
"""A node maps only the engines of its scene's contact mode; a mode that was not built is refused in one line."""
import os
import subprocess
import sys
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from spring_workbench.msg import ObjectStates

from stack import DEADLINE, Listener

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
LIBRARIES = os.environ["CMAKE_PREFIX_PATH"].split(":")[0] + "/lib/libspring_workbench_%s_engine.so"
ENGINES = {"collision": "libfcl", "rigid_bodies": "libBullet"}  # module, and what does its work
NEEDED = {"none": [], "stop": ["collision"], "dynamic": ["collision", "rigid_bodies"]}


class LeftOut(unittest.TestCase):
    def check(self, contact):
        """Starts a node with this contact mode; returns the libraries that it maps, or its error message."""
        name = "looked_at_" + contact
        rospy.set_param(name, {"scene": PACKAGE + "/scenes/mini_world.urdf", "contact": contact})
        objects = Listener(name + "/objects", ObjectStates)
        node = subprocess.Popen(
            roslib.packages.find_node("spring_workbench", "manipulation") + ["__name:=" + name],
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        try:
            if not all(os.path.exists(LIBRARIES % module) for module in NEEDED[contact]):
                said = node.communicate(timeout=DEADLINE)[0].splitlines()
                self.assertEqual((node.returncode, len(said)), (2, 1), said)
                self.assertRegex(said[0], "contact: mode '.*' is not available: it needs (FCL|Bullet)")
                return
            objects.next()
            with open("/proc/%d/maps" % node.pid) as file:
                maps = file.read()
            self.assertIn("libassimp", maps)  # it is the node that is looked at, and what it is linked with can be seen
            for module, library in ENGINES.items():
                self.assertEqual(library in maps, module in NEEDED[contact], library)
                self.assertEqual(LIBRARIES % module in maps, module in NEEDED[contact], module)
        finally:
            node.terminate()
            node.communicate(timeout=DEADLINE)
            rospy.delete_param(name)

    def test_without_contact_neither_engine_is_mapped(self):
        self.check("none")

    def test_stop_maps_fcl_alone(self):
        self.check("stop")

    def test_dynamic_maps_both(self):
        self.check("dynamic")


if __name__ == "__main__":
    rospy.init_node("left_out_test")
    rostest.rosrun("spring_workbench", "left_out_test", LeftOut, sys.argv)
