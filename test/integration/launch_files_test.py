#!/usr/bin/python3
"""The launch files and the rviz configuration as shipped, and a bag that is made here and played into the stack."""
import glob
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rosgraph
import rospkg
import rospy
import rostest
from sensor_msgs.msg import Joy
from spring_workbench.msg import ObjectStates, StepReport, TaskState
from tf2_msgs.msg import TFMessage

from stack import DEADLINE, DOWN, Listener, stylus_transform, wait_for

PACKAGE = rospkg.RosPack().get_path("spring_workbench")


class Launched:
    """roslaunch as a user runs it; ended, with all its nodes, at the end of the block."""

    def __init__(self, *arguments):
        self.arguments = ["roslaunch", "spring_workbench", *arguments]

    def __enter__(self):
        self.process = subprocess.Popen(self.arguments)
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(DEADLINE)
        if rospy.has_param("/manipulation"):
            rospy.delete_param("/manipulation")


def make_bag(path):
    """A hand that goes down into the box of single_box, grasps, lifts, carries it 0.2 m along x and holds it there."""
    waypoints = [(0.0, (0, 0, 0.4)), (1.0, (0, 0, 0.22)), (1.6, (0, 0, 0.22)), (2.6, (0, 0, 0.4)), (3.6, (0.2, 0, 0.4)),
                 (4.6, (0.2, 0, 0.4))]
    start = rospy.Time(1000)
    with rosbag.Bag(path, "w") as bag:
        for k in range(50 * 46 // 10):
            t = 0.02 * k
            (t0, a), (t1, b) = next(pair for pair in zip(waypoints, waypoints[1:]) if pair[1][0] > t)
            u = (t - t0) / (t1 - t0)
            u = u * u * (3 - 2 * u)
            stamp = start + rospy.Duration.from_sec(t)
            position = tuple(x + u * (y - x) for x, y in zip(a, b))
            bag.write("/tf", TFMessage([stylus_transform(stamp, position, DOWN)]), stamp)
            joy = Joy(buttons=[1 if t > 1.2 else 0, 0])
            joy.header.stamp = stamp
            bag.write("/stylus/joy", joy, stamp)


class LaunchFiles(unittest.TestCase):
    def test_demo_assembles_all_objects(self):
        rospy.set_param("/use_sim_time", False)
        tasks = Listener("manipulation/task", TaskState)
        with Launched("demo.launch", "rviz:=false", "pause:=1"):
            tasks.next(lambda m: m.placed >= 1, "the first object in place")
            wait_for(lambda: tasks.last.complete, "all objects in place", deadline=240.0)
        done = tasks.last
        self.assertEqual(done.targets, 7)
        self.assertTrue(all(p.in_place for p in done.placements))
        self.assertEqual(done.csv.split(",")[0], "7")
        self.assertGreater(done.hand_path, done.object_path)

    def test_bag_moves_the_object(self):
        folder = tempfile.mkdtemp()
        bag = os.path.join(folder, "hand.bag")
        make_bag(bag)
        objects, steps = Listener("manipulation/objects", ObjectStates), Listener("manipulation/steps", StepReport)
        with Launched("playback.launch", "bag:=" + bag, "scene:=package://spring_workbench/scenes/single_box.urdf",
                      "rviz:=false"):
            is_there = lambda m: (m.objects[0].held and m.objects[0].pose.position.z > 0.15 and
                                  abs(m.objects[0].pose.position.x - 0.2) < 0.01)
            objects.next(is_there, "the box to be lifted and carried")
            self.assertLess(objects.last.header.stamp.to_sec(), 1010.0)  # the bag's time
            self.assertEqual(sum(m.guards_tripped for m in steps.messages), 0)
        shutil.rmtree(folder)

    def test_rviz_shows_the_shipped_configuration(self):
        if not shutil.which("Xvfb"):
            self.skipTest("Xvfb is not installed")
        rospy.set_param("/use_sim_time", False)
        reader, writer = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-screen", "0", "800x600x24", "+extension", "GLX"],
                                  pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.environ["DISPLAY"] = ":" + os.read(reader, 16).decode().strip()
        os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
        try:
            with Launched("workbench.launch"):
                subscribers = lambda: dict(rosgraph.Master("/test").getSystemState()[1])
                wait_for(lambda: "/rviz" in subscribers().get("/manipulation/markers", []), "rviz to show the markers")
        finally:
            server.terminate()
            server.wait()

    def test_every_argument_has_a_doc(self):
        for file in glob.glob(PACKAGE + "/launch/*.launch"):
            said = subprocess.run(["roslaunch", "--ros-args", file], capture_output=True, text=True, check=True).stdout
            self.assertNotIn("undocumented", said)


if __name__ == "__main__":
    rospy.init_node("launch_files_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "launch_files_test", LaunchFiles, sys.argv)
