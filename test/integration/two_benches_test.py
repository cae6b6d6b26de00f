#!/usr/bin/python3
"""Two benches on one master, as doc/reference.md starts them: each has its own frames, hand and recording."""
import contextlib
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

import rosbag
import roslib.packages
import rospkg
import rospy
import rostest
from spring_workbench.msg import Change, ForkState
from tf2_msgs.msg import TFMessage

from stack import Launched, Listener, recorder_is_connected, wait_for

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
SCENE = "package://spring_workbench/scenes/single_box.urdf"
BENCHES = {"left": "0 0 0.4 1 0 0 0", "right": "2 0 0.4 1 0 0 0"}  # where the hand starts
SHARED = {"workbench"}  # frames that both benches send


class TwoBenches(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.stack = folder.name, contextlib.ExitStack()
        self.addCleanup(self.stack.close)
        self.transforms = [Listener(topic, TFMessage) for topic in ("/tf", "/tf_static")]
        self.forks = {bench: Listener("/%s/manipulation/fork" % bench, ForkState) for bench in BENCHES}
        self.changes = {bench: Listener("/%s/manipulation/changes" % bench, Change) for bench in BENCHES}
        for bench, start in BENCHES.items():
            names = {"frame_prefix": bench + "_", "stylus_frame": bench + "_stylus", "head_frame": bench + "_head"}
            arguments = {**names, "scene": SCENE, "start": start, "record": os.path.join(self.folder, bench)}
            given = ["%s:=%s" % argument for argument in arguments.items()]
            launched = Launched("workbench.launch", "__ns:=" + bench, "rviz:=false", "pause:=0", "loop:=true", *given)
            self.stack.enter_context(launched)

    def senders(self):
        """Who sends each frame."""
        result = {}
        for listener in self.transforms:
            for message in list(listener.messages):
                for transform in message.transforms:
                    sender = message._connection_header["callerid"]
                    result.setdefault(transform.child_frame_id, set()).add(sender)
        return result

    def follows_its_hand(self, bench):
        """Whether the fork's handle is where the stylus was at some time."""
        fork = self.forks[bench].last
        places = [
            t.transform.translation
            for message in list(self.transforms[0].messages)
            for t in message.transforms
            if t.child_frame_id == bench + "_stylus"
        ]
        handle = fork.handle.position if fork else None
        distance = lambda p: math.dist((p.x, p.y, p.z), (handle.x, handle.y, handle.z))
        return handle and any(distance(p) < 0.01 for p in places)

    def test_each_has_its_own_frames_hand_and_recording(self):
        for bench in BENCHES:
            wait_for(lambda: recorder_is_connected("/" + bench), "the recorder of " + bench)
        frames = ["box", "fork_handle", "fork_tip", "stylus", "head", "eye_left", "eye_right"]
        expected = {"%s_%s" % (bench, frame) for bench in BENCHES for frame in frames}
        wait_for(lambda: expected | SHARED <= set(self.senders()), "all frames")
        for bench in BENCHES:
            wait_for(lambda: self.follows_its_hand(bench), "the fork of %s to follow its hand" % bench)
            for _ in range(2):  # the recorder may lose what comes as it is ended
                self.changes[bench].next(lambda m: not m.state, "a comparison of states")
        for frame, senders in self.senders().items():
            benches = {sender.split("/")[1] for sender in senders}
            if frame not in SHARED:
                self.assertEqual(len(senders), 1, (frame, senders))
                self.assertEqual(benches, {frame.split("_")[0]})
        self.assertLess(self.forks["left"].last.handle.position.x, 1.0)
        self.assertGreater(self.forks["right"].last.handle.position.x, 1.0)
        self.stack.close()
        for bench in BENCHES:
            self.is_replayed(bench)

    def is_replayed(self, bench):
        bag = os.path.join(self.folder, bench + "_0.bag")
        with rosbag.Bag(bag) as recorded:
            topics = set(recorded.get_type_and_topic_info().topics)
        own = {"/%s/%s" % (bench, topic) for topic in ("stylus/joy", "manipulation/accepted", "manipulation/changes")}
        self.assertEqual(topics, own | {"/tf", "/tf_static"})
        command = [*roslib.packages.find_node("spring_workbench", "replay"), "--bag", bag]
        command += ["--scene", PACKAGE + "/scenes/single_box.urdf", "--out", os.path.join(self.folder, bench + ".csv")]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout.splitlines()[-1])
        self.assertGreater(summary["samples"], 50)
        self.assertEqual(summary["changes_mismatched"], 0)


if __name__ == "__main__":
    rospy.init_node("two_benches_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "two_benches_test", TwoBenches, sys.argv)
