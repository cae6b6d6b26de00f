#!/usr/bin/python3
"""What rviz shows while nodes start and exit, from the pixels of its window: nothing remains of a node that has exited,
and displays, markers and panel reappear when the node, rviz or the ROS master is restarted, or another scene is loaded.
Needs the setup file sourced; if the rviz plugins or a virtual display are missing, it is skipped
(exit status 77). Usage: rviz_recovery_test.py DEVEL_SPACE"""
import contextlib
import os
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from xmlrpc.client import ServerProxy

import rospy
import yaml
from std_msgs.msg import Bool, String

from screen import pixels, screen

SKIPPED = 77
DEVEL = sys.argv[1]
PLUGINS = DEVEL + "/lib/libspring_workbench_rviz.so"
SIZE = (1000, 700)
BACKGROUND = bytes([38, 42, 48])
DEADLINE = 90.0  # [s] for each thing waited for; far more than it takes
SCENES = "package://spring_workbench/scenes/"
DISPLAYS = {
    "fork": {"Class": "spring_workbench/SpringFork", "Name": "Fork", "Topic": "/manipulation/display/fork"},
    "objects": {
        "Class": "spring_workbench/Objects",
        "Name": "Objects",
        "Topic": "manipulation/display/objects",
        "Scene Topic": "manipulation/scene_description",
    },
    "markers": {"Class": "rviz/MarkerArray", "Name": "Markers", "Marker Topic": "/manipulation/markers"},
}


TRIANGLE = "facet normal 0 0 0 outer loop vertex %s vertex %s vertex %s endloop endfacet"
TETRAHEDRON = """<robot name="tetrahedron"><link name="tetrahedron">
  <inertial><mass value="1"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><mesh filename="tetrahedron.stl"/></geometry></visual>
  <collision><geometry><sphere radius="0.05"/></geometry></collision>
</link></robot>"""


class SendFilePath:
    """The service of rviz, which has no Python module: an absolute path; whether it was loaded."""

    _type, _md5sum = "rviz/SendFilePath", "*"
    _request_class, _response_class = String, Bool


def free_port():
    with socket.socket() as s:
        s.bind(("", 0))
        return s.getsockname()[1]


class Stack:
    """A display, a master, and the processes that were started with them."""

    def __init__(self, folder):
        self.folder = folder
        self.display = contextlib.ExitStack()
        self.port = free_port()
        self.environment = dict(
            self.display.enter_context(screen(*SIZE)),
            ROS_MASTER_URI="http://localhost:%d" % self.port,
            ROS_HOME=folder,
        )
        self.processes = []

    def start(self, *command):
        process = subprocess.Popen(command, env=self.environment, start_new_session=True, stdout=subprocess.DEVNULL)
        self.processes.append(process)
        return process

    def stop(self, process):
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
            try:
                process.wait(15)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()

    def master(self):
        process = self.start("roscore", "-p", str(self.port))
        self.until(
            lambda: subprocess.run(["rosparam", "list"], env=self.environment, capture_output=True).returncode == 0,
            "the master",
        )
        return process

    def manipulation(self, scene, folder=SCENES):
        return self.start(DEVEL + "/lib/spring_workbench/manipulation", "_scene:=%s%s.urdf" % (folder, scene))

    def write_empty_view(self):
        """Writes a configuration without panels and displays; returns its path."""
        path = os.path.join(self.folder, "empty.rviz")
        with open(path, "w") as file:
            yaml.safe_dump({"Panels": [], "Visualization Manager": {"Class": "", "Displays": []}}, file)
        return path

    def rviz(self, kind):
        config = {
            "Panels": [{"Class": "spring_workbench/Workbench", "Name": "Workbench"}],
            "Visualization Manager": {
                "Class": "",
                "Displays": [{"Enabled": True, "Value": True, **DISPLAYS[kind]}],
                "Enabled": True,
                "Value": True,
                "Global Options": {"Background Color": "38; 42; 48", "Fixed Frame": "world", "Frame Rate": 30},
                "Views": {
                    "Current": {
                        "Class": "rviz/Orbit",
                        "Name": "Current View",
                        "Distance": 1.2,
                        "Pitch": 0.4,
                        "Yaw": 4.4,
                        "Focal Point": {"X": 0, "Y": 0, "Z": 0.2},
                        "Target Frame": "world",
                    }
                },
            },
            "Window Geometry": {"Width": SIZE[0], "Height": SIZE[1], "X": 0, "Y": 0},
        }
        path = os.path.join(self.folder, "view.rviz")
        with open(path, "w") as file:
            yaml.safe_dump(config, file)
        return self.start("rviz", "-d", path, "__name:=rviz")

    def pixels(self):
        raw = pixels(self.environment)
        return [raw[i : i + 3] for i in range(0, len(raw), 3)]

    def until(self, condition, what):
        end = time.monotonic() + DEADLINE
        value = condition()
        while not value:
            assert time.monotonic() < end, "waited in vain for " + what
            time.sleep(0.2)
            value = condition()
        return value

    def close(self):
        for process in reversed(self.processes):
            self.stop(process)
        self.display.close()


class Recovery(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.stack = Stack(folder.name)
        self.addCleanup(self.stack.close)

    def look(self):
        """Number of pixels drawn in the view, and of black pixels in the panel beyond those when it is greyed out."""
        pixels = self.stack.pixels()
        drawn = sum(pixels[i] != BACKGROUND for i in self.view)
        left = [pixels[y * SIZE[0] + x] for y in range(40, SIZE[1] - 60) for x in range(0, self.panel_width, 1)]
        return drawn, sum(max(p) < 25 for p in left) - self.grey  # the plot is lighter

    def start_rviz(self, kind, shows):
        """Starts rviz; returns once it shows what it should."""
        rviz = self.stack.rviz(kind)
        self.stack.until(lambda: rviz.poll() is not None or shows(), "rviz to show what it should")
        self.assertIsNone(rviz.poll(), "rviz ended")
        return rviz

    def open_rviz(self, kind):
        """Opens an empty rviz; returns the position of its view."""

        def view():
            places = [i for i, p in enumerate(self.stack.pixels()) if p == BACKGROUND]
            return places if len(places) > SIZE[0] * SIZE[1] // 4 else None

        rviz = self.start_rviz(kind, view)
        self.view = self.settled(view, lambda now, before: now == before)  # its docks have their width
        self.panel_width = min(i % SIZE[0] for i in self.view) - 5
        self.grey = 0
        self.grey = self.look()[1]
        return rviz

    def shows(self, drawn, writing):
        now = self.look()
        return abs(now[0] - drawn) < 0.1 * drawn and abs(now[1] - writing) < 0.2 * writing

    def expect_shown(self, drawn, writing, what):
        try:
            self.stack.until(lambda: self.shows(drawn, writing), what)
        except AssertionError:
            self.fail("%s: %s, not %s" % (what, self.look(), (drawn, writing)))

    def expect_gone(self, what):
        self.stack.until(lambda: self.look()[0] == 0, what)

    def settled(self, look, same):
        """The state of the window, once two observations two seconds apart agree."""
        end, before = time.monotonic() + DEADLINE, None
        while time.monotonic() < end:
            now = look()
            if now and before and same(now, before):
                return now
            before = now
            time.sleep(2.0)
        self.fail("what rviz shows does not come to rest")

    def check(self, kind):
        stack = self.stack
        master = stack.master()
        rviz = self.open_rviz(kind)
        self.assertEqual(self.look()[0], 0)
        node = stack.manipulation("single_box")
        stack.until(lambda: self.look()[0] > 100, "something to be drawn")
        drawn, writing = self.settled(
            self.look, lambda now, before: now[0] == before[0] > 100 and abs(now[1] - before[1]) < 0.1 * before[1]
        )
        print("%s: %d pixels drawn, %d of the panel's writing" % (kind, drawn, writing))
        self.assertGreater(writing, 500)

        stack.stop(node)
        self.expect_gone("what the node drew to go")
        node = stack.manipulation("single_box")
        self.expect_shown(drawn, writing, "a new node to be shown")

        stack.stop(node)
        stack.stop(master)
        self.expect_gone("what the node drew to go, without a master")
        master = stack.master()
        node = stack.manipulation("single_box")
        self.expect_shown(drawn, writing, "a new node of a new master to be shown")

        for scene in ["mini_world", "single_box"]:
            subprocess.run(
                ["rosservice", "call", "/manipulation/load_scene", "scene: '%s%s.urdf'" % (SCENES, scene)],
                env=stack.environment,
                check=True,
                stdout=subprocess.DEVNULL,
            )
        self.expect_shown(drawn, writing, "the scene that was loaded last, and nothing of the one before")

        stack.stop(rviz)
        self.start_rviz(kind, lambda: self.shows(drawn, writing))

    def test_fork_of_the_display(self):
        self.check("fork")

    def test_objects_of_the_display(self):
        self.check("objects")

    def test_markers(self):
        self.check("markers")

    def say(self, topic, kind, values):
        """Publishes from a separate node for long enough."""
        sender = self.stack.start("rostopic", "pub", "-l", "manipulation/" + topic, "spring_workbench/" + kind, values)
        time.sleep(5.0)
        self.stack.stop(sender)

    def test_the_forks_of_all_styluses(self):
        """They are shown next to each other, each with the number of its stylus; that of a silent stylus disappears."""
        stack = self.stack
        stack.master()
        self.open_rviz("fork")
        drawn, senders = [0], []
        for k, number in enumerate(["", "_2", "_7", "_12"]):
            handle = "{position: {x: %g, z: 0.3}, orientation: {x: 1.0}}" % (0.2 * k - 0.3)
            fork = "{header: {frame_id: world}, tool: spring_fork, shape: constant, length: 0.2, diameter: 0.03, "
            fork += "strain: [0, 0, 0, 0], load: 0.5, proxy_handle: %s}" % handle
            topic = "manipulation/display/fork" + number
            senders.append(stack.start("rostopic", "pub", "-r", "10", topic, "spring_workbench/ForkState", fork))
            stack.until(lambda: self.look()[0] > drawn[-1] + 100, "the fork of stylus " + number)
            drawn.append(self.settled(lambda: self.look()[0], lambda now, before: now == before))
        print("pixels drawn with one fork more each time: %s" % drawn)
        for more in (b - a for a, b in zip(drawn, drawn[1:])):
            self.assertLess(abs(more - drawn[1]), 0.5 * drawn[1])
        stack.stop(senders[2])
        stack.until(lambda: abs(self.look()[0] - drawn[3]) < 0.2 * drawn[1], "the fork that is silent to go")

    def test_malformed_messages_are_harmless(self):
        stack = self.stack
        stack.master()
        rviz = self.open_rviz("objects")
        pose = "{position: {z: 0.1}, orientation: {w: 1.0}}"
        shape = "{type: %d, pose: " + pose + ", size: {x: 0.2, y: 0.2, z: 0.2}, color: {g: 1.0, a: 1.0}, mesh: 7}"
        scene = "{bodies: [{name: box, movable: true, pose: " + pose + ", visual: [" + shape + "]}]}"
        state = "{header: {frame_id: %s}, objects: [{name: box, pose: {position: {x: %s}, orientation: {w: %s}}}]}"
        topic, kind = "manipulation/display/objects", "spring_workbench/ObjectStates"
        poses = stack.start("rostopic", "pub", "-r", "10", topic, kind, state % ("world", 0, 1))
        self.say("scene_description", "SceneDescription", scene % 3)
        for bad in [("world", ".nan", 1), ("world", 0, 0), ("nowhere", 0, 1)]:
            self.say("display/objects", "ObjectStates", state % bad)
        self.assertEqual(self.look()[0], 0)
        self.say("scene_description", "SceneDescription", scene % 0)
        stack.until(lambda: self.look()[0] > 1000, "the box to be drawn")
        self.say("scene_description", "SceneDescription", scene % 9)
        self.assertGreater(self.look()[0], 1000)  # what there was stays
        stack.stop(poses)
        self.expect_gone("the box without poses to go")
        self.assertIsNone(rviz.poll())

    def test_a_mesh_is_shown_whose_file_rviz_does_not_have(self):
        """As on another host: the folder of the scene is gone before rviz starts again."""
        stack = self.stack
        stack.master()
        stack.stop(self.open_rviz("objects"))
        folder = os.path.join(stack.folder, "bench")
        os.mkdir(folder)
        corners = ["0.2 0 0", "-0.2 0.2 0", "-0.2 -0.2 0", "0 0 0.3"]
        facets = [TRIANGLE % tuple(c for c in corners if c != left_out) for left_out in corners]
        with open(os.path.join(folder, "tetrahedron.stl"), "w") as file:
            file.write("solid\n%s\nendsolid\n" % "\n".join(facets))
        with open(os.path.join(folder, "tetrahedron.urdf"), "w") as file:
            file.write(TETRAHEDRON)
        stack.manipulation("tetrahedron", folder + "/")
        described = ["rostopic", "echo", "-n", "1", "/manipulation/scene_description"]
        subprocess.run(described, env=stack.environment, check=True, timeout=DEADLINE, stdout=subprocess.DEVNULL)
        shutil.rmtree(folder)
        self.start_rviz("objects", lambda: self.look()[0] > 1000)

    def test_rviz_ends_while_the_master_hangs(self):
        stack = self.stack
        stack.master()
        stack.manipulation("single_box")
        rviz = self.open_rviz_with("objects")
        master = ServerProxy(stack.environment["ROS_MASTER_URI"]).getPid("/test")[2]
        os.kill(master, signal.SIGSTOP)
        try:
            time.sleep(3.0)  # the panel and the watch on the master ask it meanwhile
            begin = time.monotonic()
            rviz.send_signal(signal.SIGINT)
            rviz.wait(DEADLINE)
            took = time.monotonic() - begin
            print("rviz ended after %.1f s without its master's answer" % took)
            self.assertLess(took, 2.0)
        finally:
            os.kill(master, signal.SIGCONT)

    def test_panel_and_displays_are_removed_while_the_master_hangs(self):
        """Meanwhile the panel's service calls wait for the master."""
        stack = self.stack
        stack.master()
        self.open_rviz("objects")
        stack.manipulation("single_box")
        stack.until(lambda: self.look()[0] > 100, "something to be drawn")
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
        client = subprocess.Popen([sys.executable, __file__, DEVEL, "load"], env=stack.environment, **pipes)
        self.addCleanup(client.wait)
        self.addCleanup(client.kill)

        def load(path):
            begin = time.monotonic()
            print(path, file=client.stdin, flush=True)
            self.assertTrue(select.select([client.stdout], [], [], DEADLINE)[0], "rviz does not answer")
            self.assertEqual(client.stdout.readline(), "True\n")
            return time.monotonic() - begin

        print("loaded in %.1f s" % load(os.path.join(stack.folder, "view.rviz")))
        stack.until(lambda: self.look()[0] > 100, "something to be drawn again")
        master = ServerProxy(stack.environment["ROS_MASTER_URI"]).getPid("/test")[2]
        os.kill(master, signal.SIGSTOP)
        try:
            for y in range(84, 300, 12):  # down the panel's column of switches
                command = ["xdotool", "mousemove", "16", str(y), "sleep", "0.05", "click", "1"]
                subprocess.run(command, env=stack.environment, check=True)
            print("removed in %.1f s" % load(stack.write_empty_view()))
        finally:
            os.kill(master, signal.SIGCONT)

    def open_rviz_with(self, kind):
        """Opens rviz and waits until something is drawn."""
        return self.start_rviz(kind, lambda: sum(p == BACKGROUND for p in self.stack.pixels()) > SIZE[0] * SIZE[1] // 4)


def load_configurations():
    """Has rviz load each configuration whose path is read, by one connection, which needs no master."""
    rospy.init_node("loader", disable_rostime=True)
    rospy.wait_for_service("/rviz/load_config_discarding_changes", DEADLINE)
    load = rospy.ServiceProxy("/rviz/load_config_discarding_changes", SendFilePath, persistent=True)
    for line in sys.stdin:
        print(load(line.strip()).data, flush=True)


if __name__ == "__main__":
    if sys.argv[2:] == ["load"]:
        sys.exit(load_configurations())
    if not os.path.exists(PLUGINS) or not all(map(shutil.which, ["Xvfb", "import", "rviz", "xdotool"])):
        print("skipped: needs the rviz plugins, Xvfb, xdotool and ImageMagick")
        sys.exit(SKIPPED)
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
