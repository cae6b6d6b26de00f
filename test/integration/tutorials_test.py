#!/usr/bin/python3
"""Runs the tutorials command by command: every ```bash block, in order, in a temporary folder."""
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

import rospkg
import rospy
import rostest
from spring_workbench.msg import ObjectStates

from stack import DEADLINE, Listener

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
BUILD = os.path.dirname(os.environ["CMAKE_PREFIX_PATH"].split(":")[0])  # the devel space is in it


def blocks(text):
    """The ```bash blocks, each with its heading."""
    for section in re.split(r"(?m)^(?=#+ )", text):
        for block in re.findall(r"(?ms)^```bash\n(.*?)^```", section):
            yield section.splitlines()[0], block


def parts(block):
    """Returns the text before a roslaunch line, and that line with its continuation lines, or '' if there is none."""
    before, launch = re.fullmatch(r"(?ms)(.*?)(^roslaunch .*)?", block).groups()
    return before, launch or ""


class Tutorials(unittest.TestCase):
    def setUp(self):
        self.launched = None
        self.objects = Listener("manipulation/objects", ObjectStates)

    def tearDown(self):
        self.end_launch()
        self.objects.subscriber.unregister()

    def end_launch(self):
        if self.launched:
            self.launched.terminate()
            self.launched.wait(DEADLINE)
            self.launched = None
            if rospy.has_param("/manipulation"):
                rospy.delete_param("/manipulation")

    def run_tutorial(self, name, bad=()):
        """Headings in `bad` begin with commands that must be refused in one line."""
        bad = set(bad)
        with tempfile.TemporaryDirectory() as folder:
            for entry in ["config", "scenes", "scripts"]:
                os.symlink(os.path.join(PACKAGE, entry), os.path.join(folder, entry))
            os.symlink(BUILD, os.path.join(folder, "build"))
            for heading, block in blocks(open(os.path.join(PACKAGE, "doc/tutorials", name)).read()):
                before, launch = parts(block)
                before = before.replace("--duration=30", "--duration=3").replace("--trials 12", "--trials 2")
                done = subprocess.run(
                    ["bash", "-ec", before],
                    cwd=folder,
                    capture_output=True,
                    text=True,
                    timeout=2 * DEADLINE,
                )
                if heading in bad:
                    bad.remove(heading)
                    self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
                else:
                    logs = "".join(open(log).read() for log in glob.glob(folder + "/**/*.log", recursive=True))
                    self.assertEqual(done.returncode, 0, "%s: %s%s%s" % (heading, before, done.stderr, logs))
                    # Two calls are refused where nothing is held at the moment, and say so; no other is.
                    refused = re.findall(r"success: False\s+message: .?(\w+): no object is held", done.stdout)
                    self.assertLessEqual(set(refused), set(re.findall("calibrate|release", before)))
                    self.assertEqual(done.stdout.count("success: False"), len(refused), done.stdout)
                if launch:
                    self.end_launch()
                    command = launch.strip().replace("\\\n", " ") + " rviz:=false"
                    self.launched = subprocess.Popen(["bash", "-c", "exec " + command], cwd=folder)
                    self.objects.next(what="objects after " + command)
        self.assertFalse(bad)

    def test_first_grasp(self):
        rospy.set_param("/use_sim_time", False)
        self.run_tutorial("first_grasp.md")

    def test_record_and_play_back(self):
        rospy.set_param("/use_sim_time", False)
        self.run_tutorial("record_and_play_back.md")

    def test_tune_a_fork(self):
        rospy.set_param("/use_sim_time", False)
        self.run_tutorial("tune_a_fork.md")

    def test_assemble(self):
        rospy.set_param("/use_sim_time", False)
        self.run_tutorial("assemble.md")

    def test_study(self):
        rospy.set_param("/use_sim_time", False)
        self.run_tutorial("study.md")

    def test_your_own_urdf(self):
        rospy.set_param("/use_sim_time", False)
        self.run_tutorial("your_own_urdf.md", bad=["## Bad input"])


if __name__ == "__main__":
    rospy.init_node("tutorials_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "tutorials_test", Tutorials, sys.argv)
