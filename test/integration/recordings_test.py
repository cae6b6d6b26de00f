#!/usr/bin/python3
"""A synthetic hand with deliberate defects, and every recorded motion and bag of a folder, through `replay`, which
filters input like the nodes, with an object held: all values are finite, and speed, acceleration and wrench are within
limits, through every gap, flip and jump.

Usage: recordings_test.py REPLAY SCENE [FOLDER of the recordings]
"""
import csv
import glob
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

REPLAY, SCENE = sys.argv[1:3]
RECORDED = sys.argv[3] if len(sys.argv) > 3 else None
recorded = unittest.skipUnless(RECORDED, "SPRING_WORKBENCH_TEST_DATA is not given")

# The hands of the recordings move at up to 2.5 m/s; catching up adds 0.5 m/s. The object on its fork may swing faster
# than the hand by the fork's own motion. Mass 1 kg: the weight is 9.81 N.
FASTEST = 4.0  # [m/s]
STRONGEST = 250.0  # [N]
HARDEST_TURN = 25.0  # [N m]
LEFT_OUT = {  # every other file: nothing
    "falcon5_unsorted_stamps.tum": {"stamp not later": 1300},
    "tango_hard_caligula_60s.tum": {"stamp not later": 277},
    "vicon_handheld_primesense1_60s.tum": {"stamp not later": 3},
    "tumvi_room2_gaps_60s.tum": {"stamp too close": 5},  # stamps that crowd after a dropout
}
DROPOUTS = {"tumvi_room2_gaps_60s.tum": 6}
SETTINGS = ["contact=none", "grasp.object=box", "start.follow=true", "grasp.tip_in_object=0 0 0 1 0 0 0", "rate=200"]
BAND, ANGLE_BAND = 5e-4, 2e-3  # [m, rad] the dead band
SETTLED = 1.5  # [s] after which an object hangs at rest on the default fork
BAGS = {  # what is in them: parent, child; or the word of the line that refuses them
    "evo_tf_example_lz4.bag": ("odom", "base_footprint"),
    "rosbagjs_turtlesim_tf.bag": ("world", "turtle1"),
    "fuse_turtlebot3_odom_bz2.bag": "none",
    "rosbagjs_no-messages.bag": "none",
    "rosbagjs_not-a-bag.bag": "cannot be read as a bag",
}


def rests(samples, distance, angle, shortest):
    """Intervals [s] of at least this length in which all samples stay this close to the first one."""

    def near(a, b):
        cosine = abs(sum(x * y for x, y in zip(a[4:], b[4:]))) / (math.hypot(*a[4:]) * math.hypot(*b[4:]))
        return math.dist(a[1:4], b[1:4]) <= distance and 2.0 * math.acos(min(1.0, cosine)) <= angle

    found, first = [], 0
    for k in range(1, len(samples) + 1):
        if k < len(samples) and near(samples[k], samples[first]):
            continue
        if samples[k - 1][0] - samples[first][0] >= shortest:
            found.append((samples[first][0], samples[k - 1][0]))
        first = k
    return found


class Recordings(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_replay(self, *arguments):
        out = os.path.join(tempfile.mkdtemp(dir=self.folder.name), "run.csv")
        command = [REPLAY, "--scene", SCENE, "--out", out, *arguments]
        for setting in SETTINGS:
            command += ["--set", setting]
        return subprocess.run(command, capture_output=True, text=True), out

    def check(self, *arguments, may_lose=False):
        """Runs replay and checks all rows against the limits; returns the summary."""
        done, out = self.run_replay(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout.splitlines()[-1])
        rows = 0
        fastest = strongest = hardest_turn = 0.0
        with open(out.replace(".csv", ".fork.csv")) as file:
            held = []
            for row in csv.DictReader(file):
                held.append(row["held"] == "box")
                force = [float(row["tip_f" + axis]) for axis in "xyz"]
                torque = [float(row["tip_m" + axis]) for axis in "xyz"]
                self.assertTrue(all(map(math.isfinite, force + torque)), row)
                strongest = max(strongest, math.hypot(*force))
                hardest_turn = max(hardest_turn, math.hypot(*torque))
        self.assertTrue(all(held) or may_lose)
        with open(out) as file:
            for row in csv.DictReader(file):
                values = [float(v) for k, v in row.items() if k != "object"]
                self.assertTrue(all(map(math.isfinite, values)), row)
                if held[rows]:  # what was let go of falls
                    fastest = max(fastest, math.hypot(float(row["vx"]), float(row["vy"]), float(row["vz"])))
                rows += 1
        print(
            "%-40s %s\n    %d samples, left out %s, dropouts %d, found again %d; "
            "fastest %.2f m/s, strongest %.0f N, %.2f N m"
            % (
                os.path.basename(arguments[1]),
                " ".join(arguments[2:]),
                summary["samples"],
                summary["rejected"],
                summary["dropouts"],
                summary["reacquisitions"],
                fastest,
                strongest,
                hardest_turn,
            )
        )
        self.assertGreater(rows, 100)
        self.assertEqual(summary["steps_rejected"], 0)
        self.assertLess(fastest, FASTEST)
        self.assertLess(strongest, STRONGEST)
        self.assertLess(hardest_turn, HARDEST_TURN)
        return summary

    @recorded
    def test_every_motion(self):
        files = sorted(glob.glob(RECORDED + "/data/motions/*.tum"))
        self.assertGreaterEqual(len(files), 8)
        for path in files:
            with self.subTest(path=path):
                summary = self.check("--motion", path)
                name = os.path.basename(path)
                self.assertEqual(summary["rejected"], LEFT_OUT.get(name, {}))
                self.assertEqual(summary["dropouts"], DROPOUTS.get(name, 0))
                self.assertEqual(summary["reacquisitions"], DROPOUTS.get(name, 0))

    @recorded
    def test_the_object_of_a_resting_stylus_sleeps(self):
        """Whenever the stylus on eight landmarks stays within the dead band, from when the object has come to rest on
        its fork until the stylus leaves, and never otherwise. The data have one such rest, of 3 s, in which the stylus
        trembles by 0.1 mm: on the landmarks only its tip stays, about which it pivots by 10 to 40 degrees a second, and
        what it holds turns with it."""
        path = RECORDED + "/data/motions/plus_stylus_8landmarks_60s.tum"
        with open(path) as file:
            samples = [tuple(map(float, line.split())) for line in file if line.strip() and line[0] != "#"]
        intervals = [(a - samples[0][0], b - samples[0][0]) for a, b in rests(samples, BAND, ANGLE_BAND, SETTLED)]
        self.assertEqual(len(intervals), 1)
        self.assertGreater(intervals[0][1] - intervals[0][0], 3.0)
        band = ["--set", "input.dead_band.distance=%g" % BAND, "--set", "input.dead_band.angle=%g" % ANGLE_BAND]
        for arguments, sleeps in ((band, True), ([], False)):
            done, out = self.run_replay("--motion", path, *arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(out) as file:
                rows = [(float(row["t"]), list(row.values())[2:]) for row in csv.DictReader(file)]
            changes = [(t, state != before) for (t, state), (_, before) in zip(rows[1:], rows)]
            # The segment that ends at the first sample outside belongs to the hand's motion.
            at_rest = lambda t: any(begin + SETTLED <= t <= end - 0.2 for begin, end in intervals)
            in_motion = lambda t: all(not begin <= t <= end + 0.2 for begin, end in intervals)
            self.assertEqual(any(changed for t, changed in changes if at_rest(t)), not sleeps)
            self.assertEqual([t for t, changed in changes if in_motion(t) and not changed], [])

    @recorded
    def test_every_motion_whatever_the_damping(self):
        """With a fork that holds the box where it is, which with some hands is metres away: a stiff lever."""
        for path in sorted(glob.glob(RECORDED + "/data/motions/*.tum")):
            with open(path) as file:
                part = [line.split() for line in file if line.strip() and not line.startswith("#")][:600]
            for ratio in (1.0, 0.1, 0.05):
                with self.subTest(path=path, ratio=ratio):
                    damping = [f"fork.damping.{dof}={ratio}" for dof in ("stretch", "bend", "torsion")]
                    settings = ["contact=none", "grasp.object=box", "start.follow=true", *damping]
                    out = os.path.join(self.folder.name, "run.csv")
                    command = [REPLAY, "--scene", SCENE, "--motion", self.write(part), "--out", out]
                    for setting in settings:
                        command += ["--set", setting]
                    done = subprocess.run(command, capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    summary = json.loads(done.stdout.splitlines()[-1])
                    self.assertGreater(summary["steps"], 100)
                    self.assertEqual(summary["steps_rejected"], 0)
                    self.assertLessEqual(summary["steps_fallback"], 0.01 * summary["steps"])

    def write(self, samples):
        path = os.path.join(self.folder.name, "hand.tum")
        with open(path, "w") as file:
            file.writelines(" ".join(map(str, words)) + "\n" for words in samples)
        return path

    def test_a_lost_hand_releases(self):
        hand = hand_by_formula()
        del hand[1500:1700]
        summary = self.check(
            "--motion",
            self.write(hand),
            "--set",
            "input.on_loss=release",
            "--set",
            "input.loss_timeout=1.0",
            may_lose=True,
        )
        self.assertEqual(summary["dropouts"], 1)
        self.assertEqual(summary["losses"], 1)

    @recorded
    def test_a_recorded_lost_hand_releases(self):
        summary = self.check(
            "--motion",
            RECORDED + "/data/motions/tumvi_room2_gaps_60s.tum",
            "--set",
            "input.on_loss=release",
            "--set",
            "input.loss_timeout=1.0",
            may_lose=True,
        )
        self.assertGreaterEqual(summary["losses"], 1)

    @recorded
    def test_every_bag(self):
        files = sorted(glob.glob(RECORDED + "/data/bags/*.bag"))
        self.assertEqual({os.path.basename(f) for f in files}, set(BAGS))
        for path in files:
            expected = BAGS[os.path.basename(path)]
            with self.subTest(path=path):
                if isinstance(expected, tuple):
                    self.check("--bag", path, "--parent", expected[0], "--child", expected[1])
                else:
                    done, out = self.run_replay("--bag", path)
                    self.assertEqual(done.returncode, 2)
                    self.assertIn(expected, done.stderr)
                    self.assertFalse(os.path.exists(out))

    def check_spoilt(self, lines):
        """Adds single outliers, sign flips, jumps to the origin and elsewhere, and a gap, and checks the result."""
        for k, words in enumerate(lines):
            if k % 97 == 50:
                words[1] = str(float(words[1]) + 1.5)
            if k % 131 == 60:
                words[4:8] = [str(-float(w)) for w in words[4:8]]
            if 1000 <= k < 1100:
                words[1:8] = ["0.0001", "0", "0", "0", "0", "0", "1"]
            if k >= 2000:
                words[2] = str(float(words[2]) + 2.0)
        del lines[1500:1700]
        summary = self.check("--motion", self.write(lines))
        left_out = summary["rejected"]
        self.assertGreater(left_out["too fast"], 20)
        self.assertEqual(left_out["out of view"], 100)
        self.assertEqual(summary["dropouts"], 2)
        self.assertGreaterEqual(summary["reacquisitions"], 3)

    def test_all_input_faults_in_one_hand(self):
        self.check_spoilt(hand_by_formula())

    @recorded
    def test_all_input_faults_in_one_recorded_hand(self):
        with open(RECORDED + "/data/motions/vicon_handheld_primesense1_60s.tum") as file:
            lines = [line.split() for line in file if line.strip() and not line.startswith("#")][:3000]
        self.check_spoilt(lines)


def hand_by_formula():
    """30 s at 100 Hz: slow sines of 0.2 m and 0.5 rad, away from the origin."""
    lines = []
    for k in range(3000):
        t = 0.01 * k
        angle = 0.5 * math.sin(0.9 * t)
        place = [0.5 + 0.2 * math.sin(1.3 * t), 0.2 * math.sin(1.7 * t + 1.0), 0.4 + 0.1 * math.sin(1.1 * t)]
        s, c = math.sin(angle / 2), math.cos(angle / 2)
        lines.append(list(map(str, [t, *place, 0.6 * s, 0.0, 0.8 * s, c])))
    return lines


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
