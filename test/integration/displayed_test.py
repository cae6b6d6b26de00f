#!/usr/bin/python3
"""What `manipulation` shows, ahead of the newest sample: each frame and marker has the stamp and pose of a message of
the display, an object at rest has its frame sent ten times a second and a held one with each message, and how far the
display is ahead, and its error, are published."""
import collections
import contextlib
import math
import os
import signal
import subprocess
import sys
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from sensor_msgs.msg import Joy
from spring_workbench.msg import ForkState, ObjectStates, StepReport
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from stack import DEADLINE, DOWN, Listener, diagnostic_values, diagnostics_listener, stylus_transform, wait_for

SCENES = os.path.join(rospkg.RosPack().get_path("spring_workbench"), "scenes")
LATENCY = 0.03  # [s]
LENGTH = 0.2  # of the fork [m]
REPEATED = 10.0  # [Hz] frames of an object at rest


@contextlib.contextmanager
def node(scene):
    command = roslib.packages.find_node("spring_workbench", "manipulation")
    scene = "_scene:=%s/%s.urdf" % (SCENES, scene)
    process = subprocess.Popen([*command, scene, "_display_latency:=%g" % LATENCY])
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(DEADLINE)


class Hand:
    """A hand on the wall clock that sends a sample whenever it waits. It goes up to `height` at SPEED, and swings along
    x from the time `swings_from` on, once a second."""

    SPEED, SWING = 0.3, 0.05  # [m/s], [m]

    def __init__(self, place):
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.joy = rospy.Publisher("stylus/joy", Joy, queue_size=100)
        self.x, self.y, self.z = place
        self.height, self.swings_from, self.pressed = self.z, math.inf, False
        self.newest = time.time()

    def send(self):
        now = time.time()
        self.z = min(self.z + self.SPEED * (now - self.newest), self.height)
        self.newest = now
        x = self.x + self.SWING * (1.0 - math.cos(2.0 * math.pi * max(now - self.swings_from, 0.0)))
        self.tf.publish(TFMessage([stylus_transform(rospy.Time.from_sec(now), (x, self.y, self.z), DOWN)]))
        joy = Joy(buttons=[int(self.pressed)])
        joy.header.stamp = rospy.Time.from_sec(now)
        self.joy.publish(joy)

    def until(self, condition, what):
        return wait_for(lambda: self.send() or condition(), what)

    def lift(self, objects, name):
        """Grasps the object of that name, in which the tip is, and lifts it."""
        of = lambda: next(o for o in objects.last.objects if o.name == name)
        self.until(lambda: objects.last and of().highlighted, "the tip to be in the object")
        self.pressed = True
        self.until(lambda: of().held, "the object to be held")
        self.height = self.z + 0.15
        self.until(lambda: self.z == self.height, "the hand to be up")

    def swing(self, seconds):
        self.swings_from = time.time()
        self.until(lambda: self.newest > self.swings_from + seconds, "the end of the swing")


def numbers(place, rotation):
    sign = -1.0 if rotation.w < 0.0 else 1.0
    return (place.x, place.y, place.z, *(sign * q for q in (rotation.x, rotation.y, rotation.z, rotation.w)))


def of_pose(pose):
    return numbers(pose.position, pose.orientation)


def by_stamp(listener):
    """Stamp [ns] -> messages."""
    found = collections.defaultdict(list)
    for message in listener.messages:
        found[message.header.stamp.to_nsec()].append(message)
    return found


class Displayed(unittest.TestCase):
    def listen(self, topic, kind):
        listener = Listener(topic, kind)
        self.addCleanup(listener.subscriber.unregister)
        return listener

    def frames(self, listener, since=0):
        """Of each message of the node from `since` on: its stamp [ns], and transforms by frame."""
        messages = [m.transforms for m in listener.messages[since:] if len(m.transforms) > 1]  # the stylus comes alone
        return [(m[0].header.stamp.to_nsec(), {t.child_frame_id: t for t in m}) for m in messages]

    def expect_one_of(self, found, expected, what):
        """A time may be displayed again, as a newer sample makes it; frames are then not sent again."""
        difference = lambda numbers: max(abs(a - b) for a, b in zip(found, numbers))
        self.assertLess(min(map(difference, expected)), 1e-9, what)

    def check_frames(self, frames, objects, forks):
        for stamp, transforms in frames:
            self.assertTrue(stamp in objects and stamp in forks, "frames at %d, which is not displayed" % stamp)
            for name, t in transforms.items():
                self.assertEqual((t.header.stamp.to_nsec(), t.header.frame_id), (stamp, "world"))
                if name.startswith("fork"):
                    expected = [getattr(fork, name[len("fork_") :]) for fork in forks[stamp]]
                else:
                    expected = [o.pose for m in objects[stamp] for o in m.objects if o.name == name]
                found = numbers(t.transform.translation, t.transform.rotation)
                self.expect_one_of(found, map(of_pose, expected), "%s at %d" % (name, stamp))

    def check_markers(self, messages, objects, forks):
        """The box has its pose, and the arrow of the force begins at the tip."""
        compared = collections.Counter()
        for marker in (m for message in messages for m in message.markers if m.action == Marker.ADD):
            stamp = marker.header.stamp.to_nsec()
            what = "marker %s at %d" % (marker.ns, stamp)
            self.assertTrue(stamp in objects and stamp in forks, what + ", which is not displayed")
            if marker.ns == "box":
                boxes = [of_pose(m.objects[0].pose) for m in objects[stamp]]
                self.expect_one_of(of_pose(marker.pose), boxes, what)
            if marker.ns == "force":
                tips = [of_pose(fork.tip)[:3] for fork in forks[stamp]]
                self.expect_one_of((marker.points[0].x, marker.points[0].y, marker.points[0].z), tips, what)
            compared[marker.ns] += 1
        self.assertGreater(min(compared["box"], compared["force"]), 10)

    def test_frames_and_markers_are_of_the_display(self):
        objects = self.listen("manipulation/display/objects", ObjectStates)
        forks = self.listen("manipulation/display/fork", ForkState)
        steps, diagnostics = self.listen("manipulation/steps", StepReport), diagnostics_listener()
        self.addCleanup(diagnostics.subscriber.unregister)
        hand = Hand((0.03, 0.0, 0.02 + LENGTH))
        with node("single_box"):
            hand.lift(objects, "box")
            hand.until(lambda: forks.last and steps.last, "all of the display")
            tf, markers = self.listen("/tf", TFMessage), self.listen("manipulation/markers", MarkerArray)
            hand.until(lambda: self.frames(tf) and markers.last, "frames and markers")
            seen = len(steps.messages)
            hand.swing(2.0)
            frames, drawn = self.frames(tf), list(markers.messages)
            newest = max(frames[-1][0], max(m.header.stamp.to_nsec() for m in drawn[-1].markers))
            hand.until(lambda: min(x.last.header.stamp.to_nsec() for x in (objects, forks)) >= newest, "the display")
            reports = steps.messages[seen:]
            loop = lambda: diagnostic_values(diagnostics.messages, "physics loop")
            hand.until(lambda: float(loop().get("prediction error, 99 % [m]", 0.0)) > 0.0, "its error in /diagnostics")
        self.assertGreater(sum("box" in transforms for _, transforms in frames), 50)
        self.check_frames(frames, by_stamp(objects), by_stamp(forks))
        self.check_markers(drawn, by_stamp(objects), by_stamp(forks))
        error, ahead = max(m.prediction_error for m in reports), max(m.horizon for m in reports)
        print("%d frames; at most %.3g mm of error and %.3g ms ahead" % (len(frames), 1e3 * error, 1e3 * ahead))
        self.assertGreater(error, 0.0)
        self.assertGreaterEqual(ahead, LATENCY)

    def test_what_rests_is_sent_ten_times_a_second(self):
        objects = self.listen("manipulation/display/objects", ObjectStates)
        hand, held = Hand((-0.15, 0.0, 0.025 + LENGTH)), "orange_box"
        with node("mini_world"):
            hand.lift(objects, held)
            tf = self.listen("/tf", TFMessage)
            hand.until(lambda: self.frames(tf), "frames")
            seen = len(tf.messages)
            hand.swing(3.0)
            frames = self.frames(tf, seen)
            rest = {o.name for o in objects.last.objects} - {held}
        lasted = 1e-9 * (frames[-1][0] - frames[0][0])
        sent = collections.Counter(name for _, transforms in frames for name in transforms)
        print("%d frames in %.2f s: %s" % (len(frames), lasted, dict(sent)))
        self.assertEqual(len(rest), 6)
        self.assertEqual(sent[held], len(frames))
        for name in rest:
            self.assertLess(sent[name], REPEATED * lasted + 2)
            self.assertGreater(sent[name], 0.5 * REPEATED * lasted)
        self.assertGreater(len(frames), 2 * max(sent[name] for name in rest))


if __name__ == "__main__":
    rospy.init_node("displayed_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "displayed_test", Displayed, sys.argv)
