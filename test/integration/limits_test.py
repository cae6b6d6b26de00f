#!/usr/bin/python3
"""Checks the tables of doc/limits.md: every listed input is refused with the listed message, and changes nothing."""
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

import genpy
import rosbag
import rosgraph
import rosservice
import rospkg
import rospy
import rostest
import yaml

from geometry_msgs.msg import TransformStamped, WrenchStamped
from sensor_msgs.msg import Joy
from spring_workbench.msg import ForkState, ObjectStates
from stack import Listener, diagnostic_values, diagnostics_listener, wait_for
from tf2_msgs.msg import TFMessage

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
PROGRAMS = os.environ["CMAKE_PREFIX_PATH"].split(":")[0] + "/lib/spring_workbench/"
SCENE = PACKAGE + "/scenes/single_box.urdf"
LONGEST = 60.0  # [s] limit for any refusal, to detect a hang


def tables():
    """Section -> rows of two or three cells."""
    found, section = {}, None
    with open(PACKAGE + "/doc/limits.md") as file:
        for line in file:
            if line.startswith("## "):
                section = line[3:].strip()
            elif line.startswith("| ") and not line.startswith("| ---"):
                cells = [c.strip().replace("\\|", "|") for c in re.split(r"(?<!\\)\|", line)[1:-1]]
                found.setdefault(section, []).append([re.sub(r"^`+ ?(.*?) ?`+$", r"\1", c) for c in cells])
    return {name: rows[1:] for name, rows in found.items()}


def documented(section, pattern):
    """Returns the text of a section of doc/reference.md."""
    with open(PACKAGE + "/doc/reference.md") as file:
        text = re.search(r"(?ms)^## %s\n(.*?)(?=^## |\Z)" % re.escape(section), file.read()).group(1)
    found = re.findall(pattern, text, re.MULTILINE)
    assert found, section
    return found


def write(path, text):
    with open(path, "w") as file:
        file.write(text)
    return path


def merge(fields, changes):
    """Applies the changes to nested fields."""
    for key, value in changes.items():
        if isinstance(value, dict):
            merge(fields[key], value)
        else:
            fields[key] = value


def one_line(done, program):
    """The error message of a program that exited with status 2."""
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    if done.returncode != 2 or len(lines) != 1:
        return "status %d, %d lines: %s" % (done.returncode, len(lines), done.stderr[-500:])
    return lines[0].replace(program + ": ", "", 1)


class Limits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tables = tables()
        cls.node = subprocess.Popen([PROGRAMS + "manipulation", "__name:=manipulation", "_scene:=" + SCENE])
        cls.fork = Listener("manipulation/fork", ForkState)
        cls.objects = Listener("manipulation/objects", ObjectStates)
        wait_for(lambda: cls.fork.last and cls.objects.last, "the node")

    @classmethod
    def tearDownClass(cls):
        cls.node.terminate()
        cls.node.wait(LONGEST)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        write(self.folder + "/hand.tum", "0 0 0 0.4 1 0 0 0\n0.02 0 0 0.4 1 0 0 0\n")
        with open(SCENE) as file:
            self.urdf = file.read()
        self.scene_yaml = ""

    def run_program(self, words):
        before = sorted(os.listdir(self.folder))
        done = subprocess.run(
            [PROGRAMS + words[0]] + words[1:],
            cwd=self.folder,
            timeout=LONGEST,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self.assertEqual(sorted(os.listdir(self.folder)), before, "something was written")
        return one_line(done, words[0])

    def replay(self, *more, motion="hand.tum"):
        write(self.folder + "/scene.urdf", self.urdf)
        write(self.folder + "/scene.yaml", self.scene_yaml)
        return self.run_program(["replay", "--scene", "scene.urdf", "--motion", motion, "--out", "run.csv", *more])

    def walk(self, section, answer_of):
        """Checks every row of a section; the last cell is the expected message."""
        self.assertGreater(len(self.tables[section]), 0)
        wrong = []  # rosunit does not print what a subTest says
        for row in self.tables[section]:
            answer = answer_of(*row[:-1]).replace(self.folder + "/", "")
            whole = "a number" in row[-1] or "a finite number" in row[-1]  # with its unit
            if row[-1] not in answer or (whole and not answer.endswith(row[-1])):
                wrong.append("%s: documented: %s; answered: %s" % (row[:-1], row[-1], answer))
        self.assertEqual(wrong, [], section)

    def test_each_setting_parameter_and_option_has_a_row(self):
        given = {name: [row[0] for row in rows] for name, rows in self.tables.items()}
        for key in documented("Settings", r"^\| `([\w.]+)`") + documented("Input settings", r"^\| `([\w.]+)`"):
            self.assertTrue(any(setting.startswith(key + "=") for setting in given["Settings"]), key)
        for node in ["manipulation", "tracker_driver", "contact_sound"]:
            rows = [row[1] for row in self.tables["Parameters"] if row[0] == node]
            for name in documented("`%s`" % node, r"^\| `~(\w+)` \|[^|]*\|[^|]*\|[^|]*\|[^|]*\|$"):
                self.assertTrue(any(re.search(r"\b%s:" % name, row) for row in rows), "%s: %s" % (node, name))
        for program in ["fastrak_simulator", "register_tracker", "assembly_trials"]:
            rows = [row for row in given["Programs"] if row.startswith(program)]
            for option in documented("`%s`" % program, r"(--(?!help)[a-z][a-z-]*) "):
                self.assertTrue(any(option in row for row in rows), "%s: %s" % (program, option))

    def test_programs(self):
        write(self.folder + "/scene.urdf", self.urdf)
        if not os.path.exists(PROGRAMS + "report"):  # without SUNDIALS it is not built
            self.tables["Programs"] = [row for row in self.tables["Programs"] if not row[0].startswith("report")]
        self.walk("Programs", lambda command: self.run_program(shlex.split(command)))

    def test_settings(self):
        self.walk("Settings", lambda setting: self.replay("--set", setting))

    def test_urdf(self):
        good = self.urdf

        def answer(old, new):
            old, new = old.replace("⏎", "\n"), new.replace("⏎", "\n")
            self.assertIn(old, good)
            self.urdf = good.replace(old, new, 1)
            return self.replay()

        self.walk("Scenes, the URDF", answer)

    def test_scene_yaml(self):
        def answer(text):
            self.scene_yaml = text.replace("⏎", "\n") + "\n"
            return self.replay()

        self.walk("Scenes, the YAML file", answer)

    def test_motions(self):
        def answer(name, text):
            write(self.folder + "/" + name, text.replace("⏎", "\n"))
            return self.replay(motion=name)

        self.walk("Motions", answer)

    def transform(self, text, stamp):
        """Transform of the hand above the bench, with the changes in `text`."""
        fields = {
            "header": {"frame_id": "workbench"},
            "child_frame_id": "stylus",
            "transform": {
                "translation": {"x": 0.2, "y": 0.0, "z": 0.4},
                "rotation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
            },
        }
        merge(fields, yaml.safe_load(text))
        message = TransformStamped()
        genpy.message.fill_message_args(message, [fields])
        message.header.stamp = stamp
        return TFMessage([message])

    def test_bags(self):
        write(self.folder + "/scene.urdf", self.urdf)

        def answer(text):
            with rosbag.Bag(self.folder + "/a.bag", "w") as bag:
                bag.write("/tf", self.transform(text, rospy.Time(1000, 50000000)), rospy.Time(1000))
            return self.run_program(["replay", "--scene", "scene.urdf", "--bag", "a.bag", "--out", "run.csv"])

        self.walk("Bags", answer)

    def test_topics(self):
        publishers = {
            "/tf": rospy.Publisher("/tf", TFMessage, queue_size=10),
            "stylus/joy": rospy.Publisher("stylus/joy", Joy, queue_size=10),
            "~external_wrench": rospy.Publisher("manipulation/external_wrench", WrenchStamped, queue_size=10),
        }
        diagnostics = diagnostics_listener()
        wait_for(lambda: all(p.get_num_connections() > 0 for p in publishers.values()), "the node to listen")
        publishers["/tf"].publish(self.transform("{}", rospy.Time.now()))
        values = lambda status="tracker input": diagnostic_values(diagnostics.messages, status)
        wait_for(lambda: values().get("samples") == "1", "the good one")
        place = self.fork.next(lambda m: m.handle.position.x == 0.2, "the hand there").handle
        good = 1

        def answer(topic, text):
            nonlocal good
            given = yaml.safe_load(text)
            age = rospy.Duration(given.pop("age", 0))
            status = "external wrench" if topic == "~external_wrench" else "tracker input"
            before = {key: value for key, value in values(status).items() if key.startswith("rejected: ")}
            if topic == "/tf":
                publishers[topic].publish(self.transform(yaml.safe_dump(given), rospy.Time.now() - age))
                if age:  # may be of a clock that was set; one that fits says that it was not
                    publishers[topic].publish(self.transform("{}", rospy.Time.now()))
                    good += 1
            elif topic == "~external_wrench":
                wrench = WrenchStamped()
                genpy.message.fill_message_args(wrench, [{"header": {"frame_id": "world"}, **given}])
                publishers[topic].publish(wrench)
            else:
                publishers[topic].publish(Joy(buttons=given["buttons"]))
            more = lambda: [k for k, v in values(status).items() if k.startswith("rejected: ") and before.get(k) != v]
            return wait_for(more, text + " to be rejected")[0].replace("rejected: ", "")

        self.walk("Topics", answer)
        wait_for(lambda: values()["samples"] == str(good), "the good ones, and no others")
        self.assertEqual(self.fork.next().handle, place)

    def test_parameters(self):
        master = rosgraph.Master("/limits_test")

        def answer(node, parameters):
            name = "/" + node + "_refused"
            master.setParam(
                name, dict({"scene": SCENE} if node == "manipulation" else {}, **yaml.safe_load(parameters))
            )
            try:
                done = subprocess.run(
                    [PROGRAMS + node, "__name:=" + name[1:]],
                    timeout=LONGEST,
                    text=True,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                )
            finally:
                master.deleteParam(name)
            return one_line(done, node)

        self.walk("Parameters", answer)

    def state(self):
        fork, objects = self.fork.next(), self.objects.next()
        return (
            fork.tool,
            fork.integrator,
            fork.stretch_on,
            fork.bend_on,
            fork.torsion_on,
            fork.stretch_stiffness,
            fork.bend_stiffness,
            fork.torsion_stiffness,
            fork.stretch_damping_ratio,
            fork.bend_damping_ratio,
            fork.torsion_damping_ratio,
            [(o.name, o.pose.position.x, o.pose.position.y, o.pose.position.z) for o in objects.objects],
        )

    def test_services(self):
        before = self.state()

        def answer(service, request):
            name = "/manipulation/" + service
            kind = rosservice.get_service_class_by_name(name)
            message = kind._request_class()
            genpy.message.fill_message_args(message, [yaml.safe_load(request)])
            response = rospy.ServiceProxy(name, kind)(message)
            self.assertFalse(response.success)
            self.assertEqual(len(response.message.splitlines()), 1)
            return response.message

        self.walk("Services", answer)
        self.assertEqual(self.state(), before)
        self.assertIsNone(self.node.poll())


if __name__ == "__main__":
    rospy.init_node("limits_test")
    rostest.rosrun("spring_workbench", "limits_test", Limits, sys.argv)
