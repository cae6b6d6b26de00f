#!/usr/bin/python3
"""The checkpoint in a file: crash of machine and master, a full disk, and unusable files. The test has its own node and
master."""
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import roslib.packages
import rostest
import yaml

from master_test import SCENE, free_port
from stack import DEADLINE, wait_for

MANIPULATION = roslib.packages.find_node("spring_workbench", "manipulation")
OTHER_SCENE = os.path.join(os.path.dirname(SCENE), "mini_world.urdf")


class Checkpoint(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "checkpoint")
        self.environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % free_port(), ROS_HOME=folder.name)
        self.master = self.node = None
        self.addCleanup(self.kill)

    def start(self, scene=SCENE, path=None):
        """Starts a new master and a new node after killing the current ones."""
        self.kill()
        port = self.environment["ROS_MASTER_URI"].rsplit(":", 1)[1]
        self.master = subprocess.Popen(["rosmaster", "--core", "-p", port], env=self.environment)
        wait_for(lambda: self.run_tool("rosparam", "list") is not None, "the master")
        self.said = []
        self.node = subprocess.Popen(
            [*MANIPULATION, "_scene:=" + scene, "_calibrate:=none", "_checkpoint_file:=" + (path or self.path)],
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        reader = threading.Thread(target=self.said.extend, args=(self.node.stdout,), daemon=True)
        reader.start()
        wait_for(lambda: self.place() is not None, "the node")

    def kill(self):
        for process in [self.node, self.master]:
            if process:
                process.kill()
                process.wait()
        self.node = self.master = None

    def run_tool(self, *command):
        """Returns the output of a program; None if it failed."""
        done = subprocess.run(
            command, env=self.environment, capture_output=True, text=True, timeout=DEADLINE, check=False
        )
        return done.stdout if done.returncode == 0 else None

    def echo(self, topic):
        """Returns the next message; None if there is none."""
        text = self.run_tool("rostopic", "echo", "-n", "1", topic)
        return next(yaml.safe_load_all(text)) if text else None

    def place(self):
        """Position of the first object [m]."""
        message = self.echo("/manipulation/objects")
        if not message:
            return None
        position = message["objects"][0]["pose"]["position"]
        return position["x"], position["y"], position["z"]

    def move(self, x):
        call = "{action: move, name: box, pose: {position: {x: %r, y: 0.2, z: 0.3}, orientation: {w: 1.0}}}" % x
        self.assertIn("success: True", self.run_tool("rosservice", "call", "/manipulation/edit_object", call) or "")
        self.assertEqual(self.place()[:2], (x, 0.2))

    def told(self, words):
        return [line for line in self.said if words in line]

    def content(self):
        try:
            with open(self.path, encoding="ascii") as file:
                return file.read()
        except FileNotFoundError:
            return ""

    def new_content(self, old):
        return wait_for(lambda: self.content() != old and self.content(), "a new checkpoint")

    def moved_and_kept(self, x=0.123456789):
        """Moves the box and waits until the file has its position."""
        self.start()
        before = self.new_content("")
        self.move(x)
        self.new_content(before)

    def test_machine_and_master_are_gone(self):
        self.moved_and_kept()
        place = self.place()
        self.start()
        self.assertEqual(self.place(), place)
        self.assertEqual(len(self.told("resuming from the state of the node that was killed (checkpoint_file)")), 1)
        self.node.send_signal(signal.SIGINT)  # an orderly exit: the next one starts from scratch
        self.node.wait(DEADLINE)
        self.assertFalse(os.path.exists(self.path))

    def test_while_the_disk_is_full_the_node_goes_on_and_says_so(self):
        self.moved_and_kept()
        kept = self.content()
        limits = resource.prlimit(self.node.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(self.node.pid, resource.RLIMIT_FSIZE, (64, limits[1]))
        self.move(0.2)
        wait_for(lambda: self.told("File too large"), "the node to say it")
        self.move(0.3)
        said = "manipulation: checkpoint_file: %s: cannot be written: File too large" % self.path
        wait_for(lambda: said in [s["message"] for s in self.echo("/diagnostics")["status"]], "diagnostics to say it")
        self.assertEqual(len(self.told("File too large")), 1)
        self.assertEqual(self.content(), kept)
        resource.prlimit(self.node.pid, resource.RLIMIT_FSIZE, limits)
        self.new_content(kept)
        wait_for(lambda: self.told("up to date again"), "the node to say it")
        place = self.place()
        self.kill()
        self.start()
        self.assertEqual(self.place(), place)

    def test_of_a_file_that_cannot_be_used_nothing_is(self):
        """It is reported in one line and set aside, and the node stores its state in a new file."""
        self.moved_and_kept()
        self.kill()
        whole = self.content()
        for spoilt, scene, words in [
            (whole[: len(whole) // 2], SCENE, "the checkpoint is ignored: checkpoint_file: "),
            (whole.replace("000", "001"), SCENE, "damaged: they do not match the hash"),
            (whole, OTHER_SCENE, f"the checkpoint is of '{SCENE}', but the node was started with '{OTHER_SCENE}'"),
        ]:
            with self.subTest(words=words):
                with open(self.path, "w", encoding="ascii") as file:
                    file.write(spoilt)
                self.start(scene)
                self.assertEqual(len(self.told(words)), 1, self.said)
                self.assertEqual(self.told("resuming"), [])
                self.new_content(spoilt)
                with open(self.path + ".ignored", encoding="ascii") as file:
                    self.assertEqual(file.read(), spoilt)
                if scene == SCENE:
                    self.assertEqual(self.place()[:2], (0.0, 0.0))
                self.assertEqual(self.told("not up to date"), [])
                self.kill()
                os.remove(self.path)

    def test_what_is_not_ours_is_left_alone(self):
        """A FIFO, a link, a folder, a foreign file: reported once, and the node works without a checkpoint file."""
        folder = os.path.dirname(self.path)
        os.mkfifo(os.path.join(folder, "fifo"))
        os.symlink("elsewhere", os.path.join(folder, "link"))
        with open(os.path.join(folder, "other"), "w", encoding="ascii") as file:
            file.write("somebody's")
        for name, reason in [
            ("fifo", "it is not a regular file"),
            ("link", "it is a symbolic link"),
            ("", "it is not a regular file"),
            ("other", "it belongs to another program"),
            ("none/checkpoint", "No such file or directory"),
        ]:
            with self.subTest(name=name):
                path = os.path.join(folder, name)
                self.start(path=path)
                self.move(0.1)
                self.move(0.2)
                self.assertEqual(len(wait_for(lambda: self.told(reason), "the node to say it")), 1, self.said)
                self.kill()
        with open(os.path.join(folder, "other"), encoding="ascii") as file:
            self.assertEqual(file.read(), "somebody's")
        self.assertFalse(os.path.exists(os.path.join(folder, "elsewhere")))


if __name__ == "__main__":
    rostest.rosrun("spring_workbench", "checkpoint_test", Checkpoint, sys.argv)
