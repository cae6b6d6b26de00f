#!/usr/bin/python3
"""Nodes other than manipulation are killed while it works, and are restarted: it continues undisturbed."""
import shutil
import sys
import tempfile
import unittest

import rosgraph
import rospy
import rostest
from spring_workbench.msg import ForkState, StepReport

from screen import screen
from stack import Launched, Listener, kill_and_wait, pid_of, wait_for

STACK = ["workbench.launch", "scene:=package://spring_workbench/scenes/single_box.urdf", "respawn:=true"]
MOVING = ["input:=scripted", "loop:=true"]


def subscribers(topic):
    return dict(rosgraph.Master(rospy.get_name()).getSystemState()[1]).get(topic, [])


class KilledNodes(unittest.TestCase):
    def setUp(self):
        self.fork = Listener("manipulation/fork", ForkState)
        self.steps = Listener("manipulation/steps", StepReport)

    def tearDown(self):
        self.fork.subscriber.unregister()
        self.steps.subscriber.unregister()

    def see_it_move(self):
        first = self.fork.next(what="the fork").handle.position
        self.fork.next(lambda m: m.handle.position != first, "another place of the handle")

    def kill(self, node):
        """The node restarts; manipulation is still the same process, rejects no step and follows the hand."""
        self.see_it_move()
        manipulation, seen = pid_of("/manipulation"), len(self.steps.messages)
        kill_and_wait(node)
        self.see_it_move()
        self.assertEqual(pid_of("/manipulation"), manipulation)
        self.assertGreater(len(self.steps.messages), seen)
        self.assertEqual(sum(m.steps_rejected for m in self.steps.messages[seen:]), 0)

    def test_the_tracker_driver(self):
        with Launched(*STACK, *MOVING, "rviz:=false"):
            self.kill("/tracker_driver")

    def test_the_driver_of_a_fastrak(self):
        with Launched(*STACK, "input:=fastrak", "simulator:=true", "rviz:=false"):
            self.kill("/tracker_driver")

    def test_the_sound(self):
        with tempfile.TemporaryDirectory() as folder:
            with Launched(*STACK, *MOVING, "rviz:=false", "sound:=true", "sound_file:=%s/contacts.wav" % folder):
                self.kill("/contact_sound")
                wait_for(lambda: "/contact_sound" in subscribers("/manipulation/contacts"), "the sound to listen again")

    @unittest.skipUnless(shutil.which("Xvfb") and shutil.which("rviz"), "no rviz or no virtual display (xvfb)")
    def test_rviz(self):
        shown = lambda: any(name.startswith("/rviz") for name in subscribers("/manipulation/display/objects"))
        with screen(800, 600) as display, Launched(
            *STACK, *MOVING, "rviz:=true", "respawn_rviz:=true", environment=display
        ):
            wait_for(shown, "rviz to show the fork")
            self.kill("/rviz")
            wait_for(shown, "the new rviz to show the fork")


if __name__ == "__main__":
    rospy.init_node("killed_nodes_test")
    rostest.rosrun("spring_workbench", "killed_nodes_test", KilledNodes, sys.argv)
