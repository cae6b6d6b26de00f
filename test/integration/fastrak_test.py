#!/usr/bin/python3
"""tracker_driver on a simulated FASTRAK: four stations that move along x, two of them on heads, and a plug that is
pulled after 8 s."""
import sys
import unittest

import rospy
import rostest
from sensor_msgs.msg import Joy
from tf2_msgs.msg import TFMessage

from stack import Listener, diagnostic_values, diagnostics_listener, wait_for

RATE = 30.0  # [Hz] of each of four stations
COUNT = 150
STEADY = 60  # poses in a row whose stamps follow the device
LATENCY = 0.25  # [s] of the parameter
LOOP = 0.98  # [s] of the file, in which the device moves along x from 1 to 1.49 m


def follow_the_device(transforms):
    """Whether the stamps are, up to whole loops of the file, a constant time after the device measured these poses."""
    late = [t.header.stamp.to_sec() - (t.transform.translation.y - 1.0) / 0.5 for t in transforms]
    from_first = [(x - late[0] + 0.5 * LOOP) % LOOP - 0.5 * LOOP for x in late]
    return max(from_first) - min(from_first) < 0.25 / RATE


class Fastrak(unittest.TestCase):
    def test_passes_the_device_on_and_survives_a_pulled_plug(self):
        tf, joy, diagnostics = Listener("/tf", TFMessage), Listener("stylus/joy", Joy), diagnostics_listener()
        second_joy, statics = Listener("stylus_2/joy", Joy), Listener("/tf_static", TFMessage)

        ages = []  # of each message of /tf when it arrives [s]
        arrivals = rospy.Subscriber(
            "/tf", TFMessage, lambda m: ages.append((rospy.Time.now() - m.transforms[0].header.stamp).to_sec())
        )

        def of(frame):
            return [t for m in tf.messages for t in m.transforms if t.child_frame_id == frame]

        frames = ["stylus", "stylus_2", "head", "head_2"]
        wait_for(lambda: min(len(of(frame)) for frame in frames) >= COUNT, "the device's poses")
        arrivals.unregister()
        self.assertGreaterEqual(min(ages), LATENCY - 0.5 / RATE)  # an even stamp may lie half a gap after the receipt
        for frame in frames:
            transforms = of(frame)[:COUNT]
            stamps = [t.header.stamp.to_sec() for t in transforms]
            self.assertTrue(all(a < b for a, b in zip(stamps, stamps[1:])))
            for t in transforms:
                self.assertEqual(t.header.frame_id, "workbench")
                # The file: (1 + s, 2, 3) with s from 0 to 0.49; the transmitter is turned by 90 degrees about z.
                p = t.transform.translation
                self.assertAlmostEqual(p.x, -2.0, delta=1e-6)
                self.assertAlmostEqual(p.z, 3.5, delta=1e-6)
                self.assertTrue(0.999 < p.y < 1.491, p.y)
        for frame in frames:  # a busy machine may lose or delay records for a while
            wait_for(lambda: follow_the_device(of(frame)[-STEADY:]), "even stamps of " + frame)
        eyes = {t.child_frame_id: t.header.frame_id for m in statics.messages for t in m.transforms}
        self.assertEqual(
            eyes, {"eye_left": "head", "eye_right": "head", "eye_left_2": "head_2", "eye_right_2": "head_2"}
        )
        self.assertGreater(len(joy.messages), COUNT / 2)
        self.assertEqual({m.buttons[0] for m in joy.messages}, {0})
        wait_for(
            lambda: {m.buttons[0] for m in second_joy.messages} == {0, 1}, "the second stylus' switch, up and down"
        )
        self.assertEqual({m.header.frame_id for m in second_joy.messages}, {"stylus_2"})

        def values():
            return diagnostic_values(diagnostics.messages, "source")

        wait_for(lambda: values().get("times the port was lost") == "1", "the pulled plug to be told")
        lost = len(of("stylus"))
        wait_for(lambda: len(of("stylus")) > lost + COUNT, "the device to be found again")
        wait_for(lambda: "streaming" in values().get("state", ""), "the diagnostics to say so")
        self.assertTrue(all(abs(t.transform.translation.x + 2.0) < 1e-6 for t in of("stylus")))


if __name__ == "__main__":
    rospy.init_node("fastrak_test")
    rostest.rosrun("spring_workbench", "fastrak_test", Fastrak, sys.argv)
