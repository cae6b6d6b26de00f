#!/usr/bin/python3
"""register_tracker as run by a user: touches of known landmarks and pivoting about the tip, from recorded motions and
from the running driver; use of its file in the launch files."""
import os
import random
import subprocess
import sys
import tempfile
import unittest

import numpy
import rospkg
import rospy
import rostest
import tf2_msgs.msg
import yaml

from stack import Launched, Listener, StoppedThread, diagnostic_values, diagnostics_listener, slave_api, wait_for

RECORDING = os.path.join(
    rospkg.RosPack().get_path("spring_workbench"), "..", "shared", "data", "motions", "plus_stylus_8landmarks_60s.tum"
)
PROGRAM = os.path.join(os.environ["CMAKE_PREFIX_PATH"].split(":")[0], "lib", "spring_workbench", "register_tracker")
PLACES = [(0, 0, 0), (0.4, 0, 0), (0.1, 0.3, 0), (0.35, 0.25, 0.1), (0.0, 0.15, 0.2)]  # in the workbench [m]
OFFSET = (0.5, -0.2, 0.3, 0.1, -0.7, 0.1, 0.7)  # of the tracker in the workbench
TIP = (0.01, -0.02, 0.15)


def rotation(q):
    x, y, z, w = numpy.array(q) / numpy.linalg.norm(q)
    return numpy.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def place_of(p_B, offset=OFFSET):
    """Returns the point in the tracker's frame."""
    return rotation(offset[3:]).T @ (numpy.array(p_B) - offset[:3])


def turning(k):
    q = numpy.array([0.5 * numpy.sin(0.13 * k), 0.5 * numpy.cos(0.071 * k), 0.3 * numpy.sin(0.029 * k), 1.0])
    return q / numpy.linalg.norm(q)


class RegisterTracker(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.random = random.Random(1)

    def file(self, name, text=""):
        path = os.path.join(self.folder, name)
        if text:
            with open(path, "w") as file:
                file.write(text)
        return path

    def landmarks(self, places):
        return self.file(
            "landmarks.yaml",
            yaml.safe_dump(
                {
                    "landmarks": [
                        {"name": "abcdefgh"[i], "position": [float(x) for x in p]} for i, p in enumerate(places)
                    ]
                }
            ),
        )

    def motion(self, tips, noise=0.0, tip=TIP):
        """Motion of a stylus whose tip rests at each point in turn, with the button pressed for a second; the stylus
        turns all the time."""
        lines = []
        for i, p in enumerate(tips):
            for k in range(150):
                q = turning(20 * i + k)
                p_S = numpy.array(p) - rotation(q) @ numpy.array(tip) + [self.random.gauss(0, noise) for _ in range(3)]
                lines.append(
                    "%.3f %s %d" % (0.02 * len(lines), " ".join("%.9f" % x for x in (*p_S, *q)), 50 <= k < 100)
                )
        return self.file("motion.tum", "\n".join(lines) + "\n")

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60)

    def register(self, *arguments):
        out = self.file("out.yaml")
        done = self.run_program(*arguments, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out) as file:
            return yaml.safe_load(file), done.stdout

    def refuse(self, word, *arguments):
        out = self.file("refused.yaml")
        done = self.run_program(*arguments, "--out", out)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(word, done.stderr)
        self.assertFalse(os.path.exists(out))

    def check_offset(self, found, offset, position, angle):
        self.assertLess(numpy.linalg.norm(numpy.array(found[:3]) - offset[:3]), position)
        self.assertLess(numpy.linalg.norm(rotation(found[3:]) - rotation(offset[3:])), angle)

    def test_tip_and_then_landmarks(self):
        found, report = self.register("--pivot", "--motion", self.motion([(0.2, 0.1, 0.05)]))
        self.assertLess(numpy.linalg.norm(numpy.array(found["tip"]) - TIP), 1e-6)
        self.assertIn("rms", report)
        tip = self.file("tip.yaml", yaml.safe_dump(found))
        known = self.landmarks(PLACES)
        for noise, position, angle in [(0.0, 1e-6, 1e-5), (1e-3, 1e-3, 5e-3)]:
            found, report = self.register(
                "--landmarks",
                known,
                "--registration",
                tip,
                "--motion",
                self.motion([place_of(p) for p in PLACES], noise),
            )
            self.check_offset(found["offset"], OFFSET, position, angle)
            self.assertLess(numpy.linalg.norm(numpy.array(found["tip"]) - TIP), 1e-6)
            self.assertEqual(report.count("residual "), len(PLACES))

    def test_meaningless_values_are_refused(self):
        known = self.landmarks(PLACES)
        straight = [place_of(p) for p in PLACES]
        tip = self.file("tip.yaml", "tip: [0.01, -0.02, 0.15]\n")
        again = ["--landmarks", known, "--registration", tip, "--motion"]
        self.refuse("order b, a, c, d, e", *again, self.motion([straight[i] for i in (1, 0, 2, 3, 4)]))
        self.refuse("touches: expected one per landmark (5), got 4", *again, self.motion(straight[:4]))
        self.refuse("from its mean while", "--landmarks", known, "--motion", self.motion(straight))  # without the tip
        self.refuse(
            "turned too little",
            "--pivot",
            "--motion",
            self.file("still.tum", "".join("%g 0 0 0 0 0 0 1 %d\n" % (0.02 * k, k > 10) for k in range(100))),
        )
        self.refuse("missing required option --landmarks or --pivot: ")
        self.refuse("--landmarks, --pivot: cannot be given together", "--pivot", "--landmarks", known)
        self.refuse("option", "--no-such-option")

    def test_recorded_stylus_on_landmarks(self):
        """A real hand: its pauses are taken as touches, and the landmarks are these touches transformed by another
        tracker pose."""
        if not os.path.exists(RECORDING):
            self.skipTest("no recordings")
        rows = numpy.loadtxt(RECORDING)
        rows[:, 0] -= rows[0, 0]
        windows = {k: rows[k : k + 6, 1:4] for k in range(len(rows) - 6)}  # 0.4 s
        spread = {k: numpy.linalg.norm(p - p.mean(0), axis=1).max() for k, p in windows.items()}
        rests = []
        for k in sorted(spread, key=spread.get):
            apart = all(numpy.linalg.norm(windows[k].mean(0) - windows[r].mean(0)) > 0.02 for r in rests)
            if spread[k] < 3e-3 and apart and all(abs(k - r) > 8 for r in rests) and len(rests) < 7:
                rests.append(k)
        self.assertGreaterEqual(len(rests), 5)
        touches = [windows[k].mean(0) for k in sorted(rests)]
        button = numpy.zeros(len(rows), int)
        for k in rests:
            button[k : k + 6] = 1
        motion = self.file(
            "real.tum",
            "".join("%.9f %s %d\n" % (r[0], " ".join("%.9f" % x for x in r[1:]), b) for r, b in zip(rows, button)),
        )
        places = [
            rotation(OFFSET[3:]) @ p + OFFSET[:3] + [self.random.gauss(0, 5e-4) for _ in range(3)] for p in touches
        ]
        found, report = self.register("--landmarks", self.landmarks(places), "--motion", motion)
        print("%d landmarks\n%s" % (len(touches), report))
        self.check_offset(found["offset"], OFFSET, 3e-3, 3e-2)
        self.refuse("", "--landmarks", self.landmarks(places[1:] + places[:1]), "--motion", motion)

    def test_messages_lost_at_a_full_queue_are_counted(self):
        """While its thread is stopped, all but the newest messages are lost, and each is counted."""
        count, queue = 3000, 1000
        diagnostics = diagnostics_listener()
        self.addCleanup(diagnostics.subscriber.unregister)
        program = subprocess.Popen([PROGRAM, "--pivot", "--out", self.file("lost.yaml")], stdout=subprocess.DEVNULL)
        self.addCleanup(program.wait)
        self.addCleanup(program.kill)
        tf = rospy.Publisher("/tf", tf2_msgs.msg.TFMessage, queue_size=count)
        lost = lambda: diagnostic_values(diagnostics.messages, "register_tracker: messages lost").get("/tf")
        wait_for(lambda: tf.get_num_connections() > 0 and lost() == "0", "nothing to be lost yet")
        node = slave_api("/register_tracker")
        received = lambda: max(c[2] for _, connections in node.getBusStats("")[1] for c in connections)  # of messages
        before = received()
        thread = StoppedThread(program.pid)
        self.addCleanup(thread.let_go)
        for _ in range(count):
            tf.publish(tf2_msgs.msg.TFMessage())
        wait_for(lambda: received() - before >= count, "all messages to have come")
        thread.let_go()
        wait_for(lambda: int(lost()) > 0, "the lost messages to be counted")
        self.assertEqual(int(lost()), count - queue)

    def test_from_the_running_driver_and_back_into_it(self):
        rospy.set_param("/use_sim_time", False)
        motion = self.motion([place_of(p) for p in PLACES])
        known, out = self.landmarks(PLACES), self.file("live.yaml")
        tip = self.file("tip.yaml", "tip: [0.01, -0.02, 0.15]\n")
        start = ["workbench.launch", "rviz:=false", "input:=motion_file", "motion:=" + motion]
        with Launched(*start, "registration:=" + tip, "pause:=8", "speed:=2"):
            done = self.run_program("--landmarks", known, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out) as file:
            self.check_offset(yaml.safe_load(file)["offset"], OFFSET, 1e-6, 1e-5)
        rospy.delete_param("/tracker_driver")
        transforms = Listener("/tf", tf2_msgs.msg.TFMessage)
        with Launched(*start, "registration:=" + out, "pause:=3"):
            first = wait_for(
                lambda: next(
                    (t for m in transforms.messages for t in m.transforms if t.child_frame_id == "stylus"), None
                ),
                "the stylus",
            )
        p = first.transform.translation
        self.assertLess(numpy.linalg.norm([p.x, p.y, p.z]), 1e-5)  # the tip on the first landmark, the origin
        rospy.delete_param("/tracker_driver")


if __name__ == "__main__":
    rospy.init_node("register_tracker_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "register_tracker_test", RegisterTracker, sys.argv)
