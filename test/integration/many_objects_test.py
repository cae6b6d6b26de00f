#!/usr/bin/python3
"""A thousand objects, one of which a hand carries, at a rate of 1000 Hz: each sample is committed and displayed, and
the node's processor time is less than twice that with a few objects, since no cycle looks for each by its name. All
that rviz and a recording need is subscribed to."""
import math
import os
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import roslib.packages
import rospy
import rostest
from sensor_msgs.msg import Joy
from spring_workbench.msg import ForkState
from tf2_msgs.msg import TFMessage

from stack import DEADLINE, DOWN, Listener, diagnostic_values, diagnostics_listener, stylus_transform, wait_for

NODE = roslib.packages.find_node("spring_workbench", "manipulation")[0]
FEW, MANY = 25, 1024  # objects
PARTS, LENGTH, PERIOD = 4, 150, 0.005  # parts of a run, samples in each, [s]
SAMPLES = PARTS * LENGTH
TOPICS = ["objects", "display/objects", "display/markers", "steps"]
JOURNAL = ["accepted", "changes"]
BOX = """<link name="box%d"><inertial><mass value="0.1"/><inertia ixx="3e-5" iyy="3e-5" izz="3e-5" ixy="0" ixz="0"
iyz="0"/></inertial><visual><geometry><box size="0.04 0.04 0.04"/></geometry></visual><collision><geometry>
<box size="0.04 0.04 0.04"/></geometry></collision></link>
<joint name="j%d" type="floating"><parent link="workbench"/><child link="box%d"/><origin xyz="%g %g 0.02"/></joint>
"""


def write_scene(path, count):
    """A square of boxes on the bench, 0.1 m apart, the first at the origin."""
    side = math.ceil(math.sqrt(count))
    boxes = "".join(BOX % (i, i, i, 0.1 * (i % side), 0.1 * (i // side)) for i in range(count))
    with open(path, "w", encoding="utf-8") as file:
        file.write("<robot name='square'><link name='workbench'/>%s</robot>" % boxes)


def processor_time(pid):
    """Of all threads of a process that run [s]."""
    total = 0
    for thread in os.listdir("/proc/%d/task" % pid):
        with open("/proc/%d/task/%s/schedstat" % (pid, thread)) as file:
            total += int(file.read().split()[0])
    return 1e-9 * total


class ManyObjects(unittest.TestCase):
    def setUp(self):
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=1000)
        self.joy = rospy.Publisher("stylus/joy", Joy, queue_size=1000)

    def send(self, k, begin, pressed):
        stamp = rospy.Time.from_sec(begin + k * PERIOD)
        time.sleep(max(stamp.to_sec() - time.time(), 0.0))
        t = k * PERIOD
        place = (0.01 * math.sin(5.0 * t), 0.0, 0.22 + 0.1 * min(max(t - 0.5, 0.0), 1.0))
        self.tf.publish(TFMessage([stylus_transform(stamp, place, DOWN)]))
        joy = Joy(buttons=[int(pressed), 0])
        joy.header.stamp = stamp
        self.joy.publish(joy)
        return stamp.to_nsec()

    def run_with(self, count):
        """The node's processor time per sample [s], the least of several parts, and how many samples have a state, by
        topic, and the number of late cycles."""
        scene = os.path.join(self.folder, "square%d.urdf" % count)
        write_scene(scene, count)
        node = subprocess.Popen([NODE, "_scene:=" + scene, "_rate:=1000"])
        self.addCleanup(node.wait)
        self.addCleanup(node.kill)
        stamps = {topic: set() for topic in TOPICS}

        def note(message, topic):
            seconds, nanoseconds = struct.unpack_from("<II", message._buff, 4)
            stamps[topic].add(seconds * 10**9 + nanoseconds)

        came = {topic: 0 for topic in (*JOURNAL, "/tf")}

        def count_message(message, topic):
            came[topic] += message._connection_header["callerid"] == "/manipulation"

        subscribers = [rospy.Subscriber("manipulation/" + t, rospy.AnyMsg, note, t) for t in TOPICS]
        subscribers += [rospy.Subscriber("manipulation/" + t, rospy.AnyMsg, count_message, t) for t in JOURNAL]
        subscribers.append(rospy.Subscriber("/tf", rospy.AnyMsg, count_message, "/tf"))
        fork, diagnostics = Listener("manipulation/fork", ForkState), diagnostics_listener()
        everything = [*subscribers, fork.subscriber, diagnostics.subscriber, self.joy]
        wait_for(lambda: all(one.get_num_connections() > 0 for one in everything), "the node")
        wait_for(lambda: self.tf.get_num_connections() > 1, "the node to listen, as this test does")
        wait_for(lambda: came["/tf"] and came["changes"], "frames and the journal")
        begin = time.time()
        sent = [self.send(k, begin, k > 20) for k in range(100)]
        wait_for(lambda: fork.last and fork.last.held_object, "a held box")
        times = [processor_time(node.pid)]
        for first in range(100, 100 + SAMPLES, LENGTH):
            sent += [self.send(k, begin, True) for k in range(first, first + LENGTH)]
            times.append(processor_time(node.pid))
        spent = min(b - a for a, b in zip(times, times[1:])) / LENGTH
        wait_for(lambda: stamps["objects"] and max(stamps["objects"]) >= sent[-2], "the last state")
        loop = wait_for(lambda: diagnostic_values(diagnostics.messages, "physics loop"), "diagnostics")
        of_input = diagnostic_values(diagnostics.messages, "tracker input")
        lost = diagnostic_values(diagnostics.messages, "messages lost")
        text = "%d objects: %.0f us of processor time per sample; %s of %s cycles late"
        print(text % (count, 1e6 * spent, loop["deadlines missed"], loop["cycles"]))
        print("messages: %s" % came)
        self.assertGreater(came["accepted"], 0.9 * len(sent))
        self.assertGreater(came["/tf"], 0.5 * len(sent))
        self.assertEqual(fork.last.held_object, "box0")
        self.assertEqual(set(lost.values()), {"0"})
        for faults in (of_input["dropouts"], loop["cycles behind the hands"], loop["simulated time skipped [s]"]):
            self.assertEqual(faults, "0")
        for subscriber in (*subscribers, fork.subscriber, diagnostics.subscriber):
            subscriber.unregister()
        node.terminate()
        node.wait(DEADLINE)
        states = {topic: len(stamps[topic] & set(sent[100:-1])) for topic in ("objects", "display/objects")}
        return spent, states, int(loop["deadlines missed"])

    def test_what_rests_costs_nothing(self):
        with tempfile.TemporaryDirectory() as self.folder:
            few, *_ = self.run_with(FEW)
            many, states, late = self.run_with(MANY)
        print("states of %d samples: %s" % (SAMPLES - 1, states))
        self.assertEqual(states["objects"], SAMPLES - 1)
        # Of the samples that come during a late cycle, the next one shows the newest alone.
        self.assertGreaterEqual(states["display/objects"], 0.99 * states["objects"] - late)
        self.assertLess(many, 2.0 * few)


if __name__ == "__main__":
    rospy.init_node("many_objects_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "many_objects_test", ManyObjects, sys.argv)
