#!/usr/bin/python3
"""The sources of tracker_driver that are moved by messages: a marker dragged in rviz, and a game pad."""
import math
import os
import subprocess
import sys
import unittest

import rosnode
import rospy
import rostest
from sensor_msgs.msg import Joy
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit

from stack import DEADLINE, Listener, diagnostic_values, diagnostics_listener, wait_for

DEVEL = os.environ["CMAKE_PREFIX_PATH"].split(":")[0]
START = (0.1, -0.2, 0.3)


class Driver:
    """tracker_driver with a source; ended at the end of the block."""

    def __init__(self, source, *parameters):
        self.arguments = [
            DEVEL + "/lib/spring_workbench/tracker_driver",
            "_source:=" + source,
            "_start:=%g %g %g 1 0 0 0" % START,
            *parameters,
        ]

    def __enter__(self):
        self.tf, self.joy = Listener("/tf", TFMessage), Listener("stylus/joy", Joy)
        self.diagnostics = diagnostics_listener()
        if rospy.has_param("/tracker_driver"):
            rospy.delete_param("/tracker_driver")
        self.process = subprocess.Popen(self.arguments)
        wait_for(lambda: self.poses(), "the stylus")
        return self

    def __exit__(self, *_):
        rosnode.kill_nodes(["/tracker_driver"])
        self.process.wait(DEADLINE)
        for listener in [self.tf, self.joy, self.diagnostics]:
            listener.subscriber.unregister()

    def poses(self):
        return [t for m in list(self.tf.messages) for t in m.transforms if t.child_frame_id == "stylus"]

    def position(self):
        p = self.poses()[-1].transform.translation
        return p.x, p.y, p.z

    def is_at(self, place):
        return lambda: math.dist(self.position(), place) < 1e-6

    def wait_for_buttons(self, *buttons):
        wait_for(lambda: self.joy.last and self.joy.last.buttons == buttons, "buttons %s" % (buttons,))


class MovedByMessages(unittest.TestCase):
    def check_stream(self, driver):
        """For any input: increasing stamps, unit quaternions, steps that a hand can make."""
        poses = driver.poses()
        self.assertGreater(len(poses), 30)
        for a, b in zip(poses, poses[1:]):
            dt = (b.header.stamp - a.header.stamp).to_sec()
            self.assertGreater(dt, 0.0)
            pa, pb = a.transform.translation, b.transform.translation
            self.assertLess(math.dist((pa.x, pa.y, pa.z), (pb.x, pb.y, pb.z)), 2.0 * dt + 1e-3)
            q = b.transform.rotation
            self.assertAlmostEqual(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, delta=1e-9)

    def test_marker(self):
        with Driver("mouse") as driver:
            init = Listener("stylus/marker/update_full", InteractiveMarkerInit)
            marker = wait_for(lambda: init.last, "the marker").markers[0]
            self.assertEqual(marker.header.frame_id, "workbench")
            self.assertEqual(len(marker.controls), 7)
            publisher = rospy.Publisher("stylus/marker/feedback", InteractiveMarkerFeedback, queue_size=10)
            wait_for(publisher.get_num_connections, "the driver to listen")
            self.assertTrue(driver.is_at(START)())

            def send(position=START, event=InteractiveMarkerFeedback.POSE_UPDATE, entry=0, frame="workbench", w=0.0):
                feedback = InteractiveMarkerFeedback(
                    client_id="test", marker_name=marker.name, event_type=event, menu_entry_id=entry
                )
                feedback.header.frame_id = frame
                p, q = feedback.pose.position, feedback.pose.orientation
                p.x, p.y, p.z = position
                q.x, q.w = 1.0, w
                publisher.publish(feedback)

            send((0.2, 0.1, 0.5))
            wait_for(driver.is_at((0.2, 0.1, 0.5)), "the stylus at the marker")
            for bad in [
                dict(position=(float("nan"), 0, 0)),
                dict(position=(0, 0, 0), frame="elsewhere"),
                dict(position=(0, 0, 0), w=5.0),
            ]:
                send(**bad)
            wait_for(
                lambda: diagnostic_values(driver.diagnostics.messages, "source").get("poses rejected") == "3",
                "three poses rejected",
            )
            send((-0.3, 0.1, 0.5))
            wait_for(driver.is_at((-0.3, 0.1, 0.5)), "the stylus to go on")

            entries = {e.title.split("] ")[-1]: e.id for e in marker.menu_entries}
            select = InteractiveMarkerFeedback.MENU_SELECT
            send(event=select, entry=entries["Grasp"])
            driver.wait_for_buttons(1, 0, 0)
            send(event=select, entry=entries["Next tool"])
            driver.wait_for_buttons(1, 1, 0)
            driver.wait_for_buttons(1, 0, 0)
            send(event=select, entry=entries["Grasp"])
            driver.wait_for_buttons(0, 0, 0)
            grasp = rospy.ServiceProxy("tracker_driver/grasp", SetBool)
            for on in [True, False]:
                self.assertTrue(grasp(on).success)
                driver.wait_for_buttons(int(on), 0, 0)
            self.check_stream(driver)

    def test_game_pad(self):
        with Driver("joy", "_axes:=1 0 2 -1 -1 3") as driver:
            publisher = rospy.Publisher("joy", Joy, queue_size=10)
            wait_for(publisher.get_num_connections, "the driver to listen")

            def push_until(condition, what, **message):
                wait_for(lambda: publisher.publish(Joy(**message)) or condition(), what)

            push_until(
                lambda: driver.position()[0] > START[0] + 0.05, "the stylus to move", axes=[0, 1, 0, 0], buttons=[1, 0]
            )
            driver.wait_for_buttons(1, 0, 0)
            self.assertEqual(driver.position()[1:], START[1:])
            push_until(lambda: driver.position()[2] < START[2] - 0.05, "the stylus to go down", axes=[0, 0, -1, 0])
            driver.wait_for_buttons(0, 0, 0)
            publisher.publish(Joy(axes=[float("nan"), 0, 0.05, 0], buttons=[0, 1, 1]))
            driver.wait_for_buttons(0, 1, 1)
            resting = driver.position()
            seen = len(driver.poses())
            wait_for(lambda: len(driver.poses()) > seen + 20, "more samples")
            self.assertEqual(driver.position(), resting)
            self.check_stream(driver)


if __name__ == "__main__":
    rospy.init_node("moved_by_messages_test")
    rostest.rosrun("spring_workbench", "moved_by_messages_test", MovedByMessages, sys.argv)
