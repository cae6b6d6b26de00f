#!/usr/bin/python3
"""scripts/study with the simulated operator instead of a person: interrupted, continued, recorded, replayed."""
import csv
import glob
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from spring_workbench.msg import TaskState
from spring_workbench.srv import SelectTool
from visualization_msgs.msg import MarkerArray

from stack import DEADLINE, Listener, wait_for

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
TARGET = "\ntargets:\n  box: {pose: [0.12, 0.05, 0.02, 0, 0, 0, 1], position_tolerance: 0.02, angle_tolerance: 0.2}\n"
PLAN = """
scene: single_box.urdf
conditions:
  rigid: {tool: direct}
  bending: {tool: spring_fork, dofs: [bend]}
practice: 0
trials: 1
time_limit: %g
instructions: Put the box on its target.
"""
# Answers that only stand for some.
TLX = "{rigid: &same {mental: 1, physical: 2, temporal: 3, performance: 4, effort: 5, frustration: 6}, bending: *same}"


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name in ("single_box.urdf", "single_box.yaml"):
            shutil.copy(os.path.join(PACKAGE, "scenes", name), self.folder)
        with open(self.path("single_box.yaml"), "a", encoding="utf-8") as file:
            file.write(TARGET)
        self.write("tlx.yaml", TLX)
        self.write("plan.yaml", PLAN % 100)
        self.task = Listener("/manipulation/task", TaskState)
        self.board = Listener("/manipulation/display/markers", MarkerArray)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def rows(self, name):
        with open(self.path("out/" + name), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def start(self, participant="2", operator=("--operator",)):
        command = [os.path.join(PACKAGE, "scripts/study"), "--participant", participant, *operator]
        command += ["--plan", self.path("plan.yaml"), "--out", self.path("out")]
        command += ["--tlx", self.path("tlx.yaml"), "rviz:=false"]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def end(self, process, deadline=DEADLINE):
        out, err = process.communicate(timeout=deadline)
        return process.returncode, out, err

    def test_interrupted_and_continued(self):
        study = self.start()
        wait_for(lambda: os.path.exists(self.path("out/participant_002.csv")), "the first trial")
        self.task.next(lambda m: m.grasps == 1 and not m.complete, "a grasp in the second trial")
        study.send_signal(signal.SIGINT)
        status, _, err = self.end(study)
        self.assertEqual((status, err), (130, "interrupted after 1 of 2 trials; the same command continues\n"))
        first = self.rows("participant_002.csv")
        self.assertEqual([row["condition"] for row in first], ["bending"])
        self.assertEqual([row["tlx_raw"] for row in self.rows("participant_002_tlx.csv")], ["3.5"])

        seen = len(self.board.messages)
        status, out, err = self.end(self.start())
        self.assertEqual((status, err), (0, ""))
        title = "2 of 2: rigid, trial 1 of 1"
        texts = [m.text for array in self.board.messages[seen:] for m in array.markers if m.ns == "study"]
        instructions = title + "\nPut the box on its target.\nThis trial counts."
        self.assertEqual(texts[texts.index(instructions) + 1], title)  # during the trial
        self.assertIn(title, out)
        self.assertNotIn("bending", out)
        rows = self.rows("participant_002.csv")
        self.assertEqual(rows[0], first[0])
        self.assertEqual(
            [(r["participant"], r["order"], r["condition"]) for r in rows], [("2", "1", "bending"), ("2", "2", "rigid")]
        )
        for row in rows:
            self.assertEqual((row["placed"], row["targets"], row["grasps"]), ("1", "1", "1"))
            self.assertTrue(1.0 < float(row["time_s"]) < 100.0)
        self.assertEqual([row["condition"] for row in self.rows("participant_002_tlx.csv")], ["bending", "rigid"])
        self.replay()

    def replay(self):
        """Replays each bag: as in the trial, the object reaches its target with the condition's DOFs."""
        program = roslib.packages.find_node("spring_workbench", "replay")[0]
        for name, dofs in [("1_bending", {"bend"}), ("2_rigid", set())]:
            bag = self.path(f"out/participant_002/{name}_trial_1.bag")
            command = [program, "--scene", self.path("single_box.urdf"), "--bag", bag, "--out", self.path("run.csv")]
            run = subprocess.run(command, capture_output=True, text=True, check=True)
            summary = json.loads(run.stdout.splitlines()[-1])
            self.assertEqual(set(summary["active"]) & {"bend", "stretch", "torsion"}, dofs)
            self.assertGreaterEqual(summary["changes"], 1)  # the reset at its begin
            self.assertEqual((summary["changes_replayed"], summary["changes_mismatched"]), (summary["changes"], 0))
            with open(self.path("run.csv"), encoding="utf-8", newline="") as file:
                last = list(csv.DictReader(file))[-1]
            self.assertAlmostEqual(float(last["x"]), 0.12, delta=0.02)
            self.assertAlmostEqual(float(last["y"]), 0.05, delta=0.02)

    def test_a_trial_with_another_tool_does_not_count(self):
        study = self.start()
        self.task.next(lambda m: m.grasps == 1, "a grasp")
        rospy.ServiceProxy("/manipulation/select_tool", SelectTool)(tool="ray", stylus=1)
        status, _, err = self.end(study)
        self.assertEqual(
            (status, err), (1, "error: the tool was changed to ray during the trial, so this trial does not count\n")
        )
        self.assertEqual(glob.glob(self.path("out/*.csv")), [])

    def test_from_start_to_analysis_by_one_command(self):
        """Two simulated participants, in opposite orders, and their records."""
        status, out, err = self.end(self.start("1-2"), 3 * DEADLINE)
        self.assertEqual((status, err), (0, ""))
        orders = [[row["condition"] for row in self.rows(f"participant_00{k}.csv")] for k in (1, 2)]
        self.assertEqual(orders, [["rigid", "bending"], ["bending", "rigid"]])
        with open(self.path("out/analysis.md"), encoding="utf-8") as file:
            report = file.read()
        self.assertIn("2 participants", report)
        for text in ("## time [s]", "## raw NASA-TLX", "| rigid - bending |".replace("-", "−")):
            self.assertIn(text, report)
        self.assertTrue(os.path.exists(self.path("out/analysis.png")))

    def test_bad_input_is_refused_in_one_line(self):
        self.write("plan.yaml", PLAN % 0)
        for participant, word in (("2", "time_limit"), ("0", "between 1 and 999"), ("3-2", "between 3 and 999")):
            status, out, err = self.end(self.start(participant))
            self.assertEqual((status, out, len(err.splitlines())), (2, "", 1), err)
            self.assertIn(word, err)
        status, out, err = self.end(self.start("1-2", operator=()))
        self.assertEqual((status, out), (2, ""))
        self.assertIn("--participant: invalid value '1-2': expected a number or, with --operator, FIRST-LAST", err)


if __name__ == "__main__":
    rospy.init_node("study_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "study_test", Study, sys.argv)
