#!/usr/bin/python3
"""The node `tracker_driver` by its topics: a motion file of 50 samples, turned and moved by `start`, at double
speed; from the source `scripted`, as from `motion_file`."""
import sys
import unittest

import rospy
import rostest
from sensor_msgs.msg import Joy
from tf2_msgs.msg import TFMessage

from stack import Listener, diagnostic_values, diagnostics_listener, wait_for

SAMPLES, INTERVAL, SPEED = 50, 0.02, 2.0


class TrackerDriver(unittest.TestCase):
    def test_plays_the_motion(self):
        tf, joy, diagnostics = Listener("/tf", TFMessage), Listener("stylus/joy", Joy), diagnostics_listener()
        wait_for(lambda: diagnostic_values(diagnostics.messages, "source").get("state") == "over", "the motion's end")
        transforms = [t for m in tf.messages for t in m.transforms]
        stylus = [t for t in transforms if t.child_frame_id == "stylus"]
        heads = [t for t in transforms if t.child_frame_id == "head"]
        self.assertEqual(len(stylus), SAMPLES)
        self.assertEqual(len(heads), SAMPLES)
        for k, t in enumerate(stylus):
            self.assertEqual(t.header.frame_id, "workbench")
            # The file: x = 1 + 0.01 k; `start` puts the first sample at (0, 0, 0.5), turned by 90 degrees about z.
            self.assertAlmostEqual(t.transform.translation.x, 0.0, delta=1e-12)
            self.assertAlmostEqual(t.transform.translation.y, 0.01 * k, delta=1e-12)
            self.assertAlmostEqual(t.transform.translation.z, 0.5, delta=1e-12)
            since_start = (t.header.stamp - stylus[0].header.stamp).to_sec()
            self.assertAlmostEqual(since_start, k * INTERVAL / SPEED, delta=1e-3)
        pressed = [k for k, message in enumerate(joy.messages) if message.buttons[0] == 1]
        self.assertEqual(pressed, list(range(10, 30)))  # grasp_from 0.2 s, grasp_until 0.6 s
        self.assertTrue(all(message.buttons[1] == 0 for message in joy.messages))
        self.assertEqual(diagnostic_values(diagnostics.messages, "source")["samples sent"], str(SAMPLES))


if __name__ == "__main__":
    rospy.init_node("tracker_driver_test")
    rostest.rosrun("spring_workbench", "tracker_driver_test", TrackerDriver, sys.argv)
