#!/usr/bin/python3
"""The tracker's driver is killed while it moves the hand, and comes back: manipulation goes on."""
import sys
import unittest

import rospy
import rostest
from spring_workbench.msg import ForkState

from stack import Launched, Listener, kill_and_wait, pid_of

SCENE = "scene:=package://spring_workbench/scenes/single_box.urdf"


class KilledDriver(unittest.TestCase):
    def test_it_comes_back_and_moves_the_hand_again(self):
        fork = Listener("manipulation/fork", ForkState)
        with Launched("workbench.launch", SCENE, "input:=scripted", "loop:=true", "rviz:=false", "respawn:=true"):

            def see_it_move():
                first = fork.next(what="the fork").handle.position
                fork.next(lambda m: m.handle.position != first, "another place of the handle")

            see_it_move()
            node = pid_of("/manipulation")
            kill_and_wait("/tracker_driver")
            see_it_move()
            self.assertEqual(pid_of("/manipulation"), node)


if __name__ == "__main__":
    rospy.init_node("killed_driver_test")
    rostest.rosrun("spring_workbench", "killed_driver_test", KilledDriver, sys.argv)
