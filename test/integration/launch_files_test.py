#!/usr/bin/python3
"""The shipped launch files and rviz configuration, and a bag that the test writes and plays into the stack."""
import glob
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rosgraph
import roslib.packages
import rospkg
import rospy
import rostest
import yaml
from spring_workbench.msg import Change, ForkState, ObjectStates, StepReport, TaskState
from tf2_msgs.msg import TFMessage

from screen import screen
from stack import Launched, Listener, make_bag, recorder_is_connected, wait_for

PACKAGE = rospkg.RosPack().get_path("spring_workbench")


class LaunchFiles(unittest.TestCase):
    def test_demo_assembles_all_objects(self):
        rospy.set_param("/use_sim_time", False)
        tasks, forks = Listener("manipulation/task", TaskState), Listener("manipulation/fork", ForkState)
        with tempfile.TemporaryDirectory() as folder, Launched("demo.launch", "rviz:=false", "pause:=1"):
            command = [PACKAGE + "/scripts/demo_report", folder + "/demo.png", folder + "/score.csv"]
            report = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
            tasks.next(lambda m: m.placed >= 1, "the first object in place")
            wait_for(lambda: tasks.last.complete, "all objects in place", deadline=240.0)
            told = report.communicate(timeout=60.0)[0]
        self.assertEqual(report.returncode, 0, told)
        self.tells_the_order_of_weights(told)
        done = tasks.last
        self.assertEqual(done.targets, 7)
        self.assertTrue(all(p.in_place for p in done.placements))
        self.assertEqual(done.csv.split(",")[0], "7")
        self.assertGreater(done.hand_path, done.object_path)
        carried = [m for m in forks.messages if m.held_object == "orange_box"]
        self.assertGreater(max(abs(m.torsion) for m in carried), math.radians(10))
        self.assertGreater(max(math.hypot(*m.bend) for m in carried), 0.05)
        self.assertGreater(max(m.stretch for m in carried), 0.05)

    def tells_the_order_of_weights(self, report):
        """The largest mean stretch of each object, as it is printed: in the order of their masses, and with the leaning
        fork in proportion to them, but for the acceleration of the hand."""
        masses = [
            ("red_box", 0.1),
            ("purple_sphere", 0.3),
            ("white_sphere", 0.5),
            ("green_box", 1.0),
            ("yellow_box", 3.0),
            ("steel_sphere", 10.0),
            ("orange_box", 30.0),
        ]
        stretch = dict(re.findall(r"(?m)^  (\w+) +(\S+) mm$", report))
        self.assertEqual(list(stretch), [name for name, _ in masses], report)
        per_mass = [float(stretch[name]) / mass for name, mass in masses]
        self.assertLess(max(per_mass), 1.3 * min(per_mass), report)

    def test_the_operator_works_with_two_hands(self):
        """It carries a bar with both hands, and hands a box over from one to the other."""
        rospy.set_param("/use_sim_time", False)
        tasks = Listener("manipulation/task", TaskState)
        forks = [Listener("manipulation/fork" + suffix, ForkState) for suffix in ("", "_2")]
        poses = Listener("/tf", TFMessage)
        self.addCleanup(poses.subscriber.unregister)
        scene = "scene:=package://spring_workbench/scenes/two_handed.urdf"
        with Launched("workbench.launch", scene, "input:=operator", "rviz:=false"):
            wait_for(lambda: tasks.last and tasks.last.complete, "all objects in place", deadline=240.0)
        stamps = [
            {t.header.stamp for m in poses.messages for t in m.transforms if t.child_frame_id == stylus}
            for stylus in ("stylus", "stylus_2")
        ]
        self.assertGreater(len(stamps[0] & stamps[1]), 0.9 * min(map(len, stamps)))  # both hands move at one time
        self.assertGreaterEqual(tasks.last.grasps, 4)  # each hand scores: two on the bar, and two on the box
        held = [{m.header.stamp: m.held_object for m in fork.messages} for fork in forks]
        pairs = {(held[0][stamp], held[1][stamp]) for stamp in held[0].keys() & held[1].keys()}
        self.assertLessEqual({("bar", "bar"), ("box", ""), ("box", "box"), ("", "box")}, pairs)

    def parameters(self, *arguments):
        command = ["roslaunch", "--dump-params", "spring_workbench", *arguments]
        return yaml.safe_load(subprocess.run(command, capture_output=True, text=True, check=True).stdout)

    def test_by_default_one_fork_is_for_all_objects_of_the_scene(self):
        hosts = ["hosts.launch", "tracker_host:=a", "rviz_host:=b"]
        for arguments in (["workbench.launch"], ["demo.launch"], ["playback.launch", "bag:=a.bag"], hosts):
            self.assertEqual(self.parameters(*arguments)["/manipulation/calibrate"], "world", arguments)

    def test_settings_of_a_file_take_precedence_over_arguments(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as settings:
            settings.write("{calibrate: none, massless: true, input: {dead_band: {angle: 0.01}}}")
            settings.flush()
            arguments = ["settings:=" + settings.name, "calibrate:=object", "error_bound:=false", "dead_band:=1e-3"]
            parameters = self.parameters("workbench.launch", *arguments)
        expected = {"calibrate": "none", "massless": True, "error_bound": False}
        expected.update({"input/dead_band/angle": 0.01, "input/dead_band/distance": 1e-3})
        self.assertEqual({key: parameters["/manipulation/" + key] for key in expected}, expected)

    def test_tracker_and_manipulation_name_the_same_frames(self):
        for source in ("mouse", "fastrak", "operator"):  # one of each way to start a tracker
            arguments = ["input:=" + source, "stylus_frame:=pen", "workbench_frame:=table", "head_frame:=cap"]
            parameters = self.parameters("workbench.launch", *arguments)
            self.assertEqual(parameters["/tracker_driver/head_frame"], "cap", source)
            for node in ("/manipulation/", "/tracker_driver/"):
                frames = [parameters[node + key] for key in ("stylus_frame", "workbench_frame")]
                self.assertEqual(frames, ["pen", "table"], (source, node))

    def test_bag_moves_the_object(self):
        folder = tempfile.mkdtemp(prefix="a folder ")
        bag = os.path.join(folder, "hand.bag")
        make_bag(bag)
        objects, steps = Listener("manipulation/objects", ObjectStates), Listener("manipulation/steps", StepReport)
        with Launched(
            "playback.launch", "bag:=" + bag, "scene:=package://spring_workbench/scenes/single_box.urdf", "rviz:=false"
        ):
            is_there = lambda m: (
                m.objects[0].held
                and m.objects[0].pose.position.z > 0.12
                and abs(m.objects[0].pose.position.x - 0.2) < 0.01
            )
            objects.next(is_there, "the box to be lifted and carried")
            self.assertLess(objects.last.header.stamp.to_sec(), 1010.0)  # the bag's time
            self.assertGreater(len(steps.messages), 0)
            self.assertEqual(sum(m.steps_rejected for m in steps.messages), 0)
        shutil.rmtree(folder)

    def test_a_bag_that_is_not_there_ends_the_launch(self):
        with Launched("playback.launch", "bag:=/nowhere/a.bag", "rviz:=false") as launched:
            wait_for(lambda: launched.process.poll() is not None, "roslaunch to end")

    def test_a_sound_file_switches_sound_on(self):
        self.assertEqual(self.parameters("workbench.launch", "sound_file:=/a.wav")["/contact_sound/file"], "/a.wav")

    def test_a_recorded_run_is_replayed(self):
        rospy.set_param("/use_sim_time", False)
        objects, changes = Listener("manipulation/objects", ObjectStates), Listener("manipulation/changes", Change)
        with tempfile.TemporaryDirectory(prefix="a folder ") as folder:
            record = "record:=" + os.path.join(folder, "run")
            frames = ["stylus_frame:=pen", "workbench_frame:=table"]
            with Launched("workbench.launch", "rviz:=false", "pause:=0", record, *frames):
                wait_for(recorder_is_connected, "the recorder")
                objects.next(lambda m: any(o.held for o in m.objects), "an object to be held")
                for _ in range(2):  # the recorder may lose what comes as it is ended
                    changes.next(lambda m: not m.state, "a comparison of states after that")
            command = [*roslib.packages.find_node("spring_workbench", "replay"), "--bag", folder + "/run_0.bag"]
            command += ["--scene", PACKAGE + "/scenes/mini_world.urdf", "--out", folder + "/run.csv"]
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            summary = json.loads(done.stdout.splitlines()[-1])
            self.assertGreater(summary["samples"], 50)
            self.assertEqual(summary["changes_mismatched"], 0)
            with rosbag.Bag(folder + "/run_0.bag") as recorded:
                topics = recorded.get_type_and_topic_info().topics
                comparisons = [m for _, m, _ in recorded.read_messages("/manipulation/changes") if not m.state]
            self.assertGreater(len(comparisons), 0)
            for topic in ("/tf", "/stylus/joy", "/manipulation/accepted"):
                self.assertIn(topic, topics)

    def test_a_recording_is_split_by_size(self):
        """Into bags of about a megabyte each; the first one is complete while the second is written."""
        rospy.set_param("/use_sim_time", False)
        with tempfile.TemporaryDirectory() as folder:
            arguments = ["rviz:=false", "loop:=true", "record_size:=1", "record:=" + os.path.join(folder, "run")]
            with Launched("workbench.launch", *arguments):
                second = folder + "/run_1.bag.active"
                begun = lambda: os.path.exists(second) and os.path.getsize(second) > 1e5
                wait_for(begun, "a second bag", deadline=180.0)
            self.assertLess(os.path.getsize(folder + "/run_0.bag"), 3e6)
            for name in ("run_0.bag", "run_1.bag"):
                with rosbag.Bag(os.path.join(folder, name)) as bag:
                    self.assertGreater(bag.get_message_count("/manipulation/accepted"), 0, name)

    def test_a_full_disk_ends_the_recording_alone(self):
        rospy.set_param("/use_sim_time", False)
        steps = Listener("manipulation/steps", StepReport)
        with tempfile.TemporaryDirectory() as folder, open(os.path.join(folder, "said"), "w+") as log:
            arguments = ["rviz:=false", "record_min_space:=1000000000G", "record:=" + os.path.join(folder, "run")]
            with Launched("workbench.launch", *arguments, output=log):
                is_logged = lambda: log.seek(0) or "Disabling recording" in log.read()
                wait_for(is_logged, "the recorder to stop")
                seen = len(steps.messages)
                wait_for(lambda: len(steps.messages) > seen + 10, "the simulation to continue")

    def test_rviz_shows_the_shipped_configuration(self):
        if not shutil.which("Xvfb"):
            self.skipTest("Xvfb is not installed")
        rospy.set_param("/use_sim_time", False)
        with screen(800, 600) as display, Launched("workbench.launch", environment=display):
            subscribers = lambda: dict(rosgraph.Master("/test").getSystemState()[1])
            shown = lambda: "/rviz" in subscribers().get("/manipulation/display/objects", [])
            wait_for(shown, "rviz to show the objects")

    def test_every_argument_has_a_doc(self):
        for file in glob.glob(PACKAGE + "/launch/*.launch"):
            log = subprocess.run(["roslaunch", "--ros-args", file], capture_output=True, text=True, check=True).stdout
            self.assertNotIn("undocumented", log)


if __name__ == "__main__":
    rospy.init_node("launch_files_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "launch_files_test", LaunchFiles, sys.argv)
