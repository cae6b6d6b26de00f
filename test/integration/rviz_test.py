#!/usr/bin/python3
"""rviz with the panel, the fork's display and the marker of the mouse, operated by clicks and drags on a virtual
display; panels of nodes with other names, and what rviz saves of them."""
import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
import rosgraph
import yaml
from sensor_msgs.msg import Joy
from spring_workbench.msg import ForkState, ObjectStates
from spring_workbench.srv import SetIntegrator, SetIntegratorRequest

from screen import pixels, screen
from stack import DEADLINE, Launched, Listener, wait_for

PACKAGE = rospkg.RosPack().get_path("spring_workbench")
PLUGINS = os.environ["CMAKE_PREFIX_PATH"].split(":")[0] + "/lib/libspring_workbench_rviz.so"
SIZE = (1200, 760)
BACKGROUND = bytes([38, 42, 48])
ARROW = 0.115  # [m] from the handle, of the marker
FOCUS, DISTANCE = 0.25, 1.0  # height [m] that the camera looks at, along +y, and from how far


def xdotool(*arguments):
    subprocess.run(["xdotool", *[str(a) for a in arguments]], check=True, timeout=DEADLINE)


def config(folder):
    """The shipped configuration, with the view along +y."""
    content = yaml.safe_load(open(PACKAGE + "/rviz/workbench.rviz"))
    manager = content["Visualization Manager"]
    manager["Views"]["Current"].update(
        {"Pitch": 0.0, "Yaw": 4.712389, "Distance": DISTANCE, "Focal Point": {"X": 0.0, "Y": 0.0, "Z": FOCUS}}
    )
    content["Window Geometry"] = {"Width": SIZE[0], "Height": SIZE[1], "X": 0, "Y": 0}
    path = os.path.join(folder, "view.rviz")
    with open(path, "w") as file:
        yaml.safe_dump(content, file)
    return path


@contextlib.contextmanager
def window_manager():
    windows = subprocess.Popen(["openbox"], stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        windows.terminate()
        windows.wait(DEADLINE)


class Picture:
    """Locates the 3D view in the window by its background colour, and projects points into it."""

    def __init__(self):
        width, height = SIZE
        shown = pixels(os.environ)
        rows = [shown[3 * width * y : 3 * width * (y + 1)] for y in range(height)]
        wide = [y for y, row in enumerate(rows) if row.count(BACKGROUND) > width // 4]
        self.rows = rows
        self.ready = bool(wide)
        if not self.ready:
            return
        columns = [x for x in range(width) if rows[wide[0] + 20][3 * x : 3 * x + 3] == BACKGROUND]
        left, right, top = columns[0], columns[-1], wide[0]
        grey = rows[height - 4][3 * (width // 2) : 3 * (width // 2) + 3]  # of the status bar
        bottom = next(y for y in range(height - 4, top, -1) if rows[y][3 * (left + 5) : 3 * (left + 5) + 3] != grey)
        self.centre = ((left + right) / 2, (top + bottom) / 2)
        self.metres = 2 * DISTANCE * 0.41421356 / (bottom - top)  # a pixel, at the distance of the focal point

    def colour(self, pixel):
        x, y = pixel
        return self.rows[y][3 * x : 3 * x + 3]

    def pixel(self, position):
        return (
            round(self.centre[0] + position.x / self.metres),
            round(self.centre[1] - (position.z - FOCUS) / self.metres),
        )


def listeners(topic):
    """The nodes that subscribe to a topic, by the master's list."""
    return dict(rosgraph.Master("/test").getSystemState()[1]).get(topic, [])


def switch_torsion(fork):
    """Clicks down the panel's column of switches until torsion is switched, and leaves the pointer there."""
    before = fork.next().torsion_on
    for y in range(84, 300, 12):
        xdotool("mousemove", 16, y, "sleep", 0.1, "click", 1)
        with contextlib.suppress(AssertionError):  # most of the column is no switch of torsion
            wait_for(lambda: fork.last.torsion_on != before, "torsion to be switched", 1.5)
            return
    raise AssertionError("no switch of torsion in the panel")


class OnScreen(unittest.TestCase):
    """A virtual display with a window manager, and a folder."""

    def setUp(self):
        rospy.set_param("/use_sim_time", False)
        self.stack = contextlib.ExitStack()
        self.addCleanup(self.stack.close)
        self.folder = self.stack.enter_context(tempfile.TemporaryDirectory())
        os.environ.update(self.stack.enter_context(screen(*SIZE)))
        self.stack.enter_context(window_manager())


@unittest.skipUnless(os.path.exists(PLUGINS), "the rviz plugins were not built")
@unittest.skipUnless(
    all(map(shutil.which, ["Xvfb", "openbox", "xdotool", "import"])),
    "Xvfb, openbox, xdotool or ImageMagick is not installed",
)
class Rviz(OnScreen):
    def setUp(self):
        super().setUp()
        self.fork, self.joy = Listener("manipulation/fork", ForkState), Listener("stylus/joy", Joy)
        self.objects = Listener("manipulation/objects", ObjectStates)
        self.stack.enter_context(
            Launched(
                "workbench.launch",
                "input:=mouse",
                "rviz_config:=" + config(self.folder),
                "scene:=package://spring_workbench/scenes/single_box.urdf",
                "settings:=" + PACKAGE + "/config/demo_fork.yaml",
            )
        )
        wait_for(lambda: "/rviz" in listeners("/manipulation/fork"), "the panel to listen")
        self.picture = wait_for(lambda: (lambda p: p.ready and p)(Picture()), "rviz to show the scene")
        wait_for(lambda: self.fork.messages, "the hand")
        wait_for(lambda: Picture().colour(self.arrow()) != BACKGROUND, "the marker to be drawn")

    def hand(self):
        return self.fork.last.handle.position

    def arrow(self):
        """A point on the marker's right arrow that nothing else covers [px]."""
        x, y = self.picture.pixel(self.hand())
        return x + round(ARROW / self.picture.metres), y

    def grab(self):
        """A point on the marker's ball, next to the arrow that points to the viewer [px]."""
        x, y = self.picture.pixel(self.hand())
        return x - 12, y + 8

    def drag_to(self, x, z):
        """Drags the marker's arrows until the hand is there."""
        self.picture = Picture()  # the panel may have changed its width
        arrow = ARROW / self.picture.metres  # [pixels]
        for _ in range(8):
            dx, dz = x - self.hand().x, z - self.hand().z
            if abs(dx) < 0.006 and abs(dz) < 0.006:
                return
            if abs(dz) >= 0.006:
                self.drag((0, -arrow), (0, -dz / self.picture.metres))
            if abs(dx) >= 0.006:
                self.drag((arrow, 0), (dx / self.picture.metres, 0))
        self.fail("the hand is at %s, not at x %g, z %g" % (self.hand(), x, z))

    def drag(self, grip, way):
        """Drags from a point next to the handle, by a displacement [px]."""
        begin = [a + b for a, b in zip(self.picture.pixel(self.hand()), grip)]
        steps = 20
        xdotool("mousemove", round(begin[0]), round(begin[1]), "sleep", 0.4, "mousedown", 1)
        for k in range(1, steps + 1):
            xdotool("mousemove", *[round(a + b * k / steps) for a, b in zip(begin, way)], "sleep", 0.04)
        xdotool("sleep", 0.5, "mouseup", 1, "sleep", 0.8)

    def choose_grasp(self, down):
        x, y = self.grab()
        xdotool("mousemove", x, y, "sleep", 0.3, "click", 3)
        entry = (x + 40, y + 12)
        wait_for(lambda: min(Picture().colour(entry)) > 150, "the menu, which is light")
        xdotool("mousemove", *entry, "sleep", 0.3, "click", 1)
        wait_for(lambda: self.joy.last.buttons[0] == down, "the grasp button %s" % ("down" if down else "up"), 15.0)

    def test_panel_switches_torsion(self):
        self.assertTrue(self.fork.next().torsion_on)
        switch_torsion(self.fork)
        xdotool("click", 1)
        self.fork.next(lambda m: m.torsion_on, "torsion on again")

    def test_panel_changes_the_integrator_and_keeps_the_tolerance(self):
        set_integrator = rospy.ServiceProxy("manipulation/set_integrator", SetIntegrator)
        self.assertTrue(set_integrator("exponential", 0.0, 1e-5).success)
        for y in range(200, 340, 8):  # down the panel, to the choice of the integrator
            xdotool("mousemove", 200, y, "sleep", 0.1, "click", 1, "sleep", 0.4, "key", "Down", "key", "Return")
            with contextlib.suppress(AssertionError):
                wait_for(lambda: self.fork.last.integrator != "exponential", "another integrator", 1.5)
                break
        self.assertEqual(self.fork.next().integrator, "rosenbrock")
        message = set_integrator("exponential", 0.0, SetIntegratorRequest.KEEP_TOLERANCE).message
        self.assertIn("tolerance 1e-5 m", message)

    def test_object_is_moved_with_the_mouse_alone(self):
        box = self.objects.next().objects[0]
        lying = box.pose.position
        self.drag_to(lying.x, lying.z + 0.2)  # the fork is 0.2 m long
        self.choose_grasp(1)
        self.objects.next(lambda m: m.objects[0].held, "the box to be held")
        self.drag_to(lying.x, 0.4)
        self.objects.next(lambda m: m.objects[0].pose.position.z > lying.z + 0.08, "the box to be lifted")
        self.drag_to(lying.x + 0.12, 0.4)
        self.drag_to(lying.x + 0.12, lying.z + 0.21)
        self.choose_grasp(0)
        there = self.objects.next(lambda m: not m.objects[0].held and m.objects[0].asleep, "the box at rest").objects[0]
        self.assertAlmostEqual(there.pose.position.x, lying.x + 0.12, delta=0.03)
        self.assertAlmostEqual(there.pose.position.z, lying.z, delta=0.005)


@unittest.skipUnless(os.path.exists(PLUGINS), "the rviz plugins were not built")
@unittest.skipUnless(
    all(map(shutil.which, ["Xvfb", "openbox", "xdotool", "import"])),
    "Xvfb, openbox, xdotool or ImageMagick is not installed",
)
class Benches(OnScreen):
    """Nodes in two namespaces, one of them with another name."""

    NODES = ["/left/manipulation", "/right/bench"]

    def setUp(self):
        super().setUp()
        self.forks = [Listener(node + "/fork", ForkState) for node in self.NODES]
        for node in self.NODES:
            namespace, name = node.rsplit("/", 1)
            scene = "_scene:=package://spring_workbench/scenes/single_box.urdf"
            program = roslib.packages.find_node("spring_workbench", "manipulation")
            self.start(*program, scene, "_frame_prefix:=%s_" % name, "__ns:=" + namespace, "__name:=" + name)
        wait_for(lambda: all(fork.last for fork in self.forks), "the nodes")

    def start(self, *command):
        process = subprocess.Popen(command)
        self.stack.callback(process.wait, DEADLINE)
        self.stack.callback(process.kill)

    def start_rviz(self, *nodes):
        """rviz with a panel for each of the nodes; returns the path of its configuration."""
        panels = [{"Class": "spring_workbench/Workbench", "Name": node, "Node": node} for node in nodes]
        geometry = {"Width": SIZE[0], "Height": SIZE[1], "X": 0, "Y": 0}
        path = os.path.join(self.folder, "panels.rviz")
        with open(path, "w") as file:
            yaml.safe_dump({"Panels": panels, "Window Geometry": geometry}, file)
        self.start("rviz", "-d", path, "__name:=rviz")
        return path

    def test_each_panel_follows_its_node(self):
        self.start_rviz("left/manipulation", "/right/bench")
        for node in self.NODES:
            for topic in (node + "/fork", node + "/steps", node.rsplit("/", 1)[0] + "/stylus/joy"):
                wait_for(lambda: "/rviz" in listeners(topic), "a panel to listen to " + topic)
        wait_for(lambda: "/rviz" not in listeners("/manipulation/fork"), "no panel to follow the default node")

    def type_node(self, text):
        """Types into the uppermost field of the panel, which is the node's."""

        def field():
            shown = pixels(os.environ)
            white = [[shown[3 * (y * SIZE[0] + x)] > 250 for x in range(60, 160)] for y in range(60, 400)]
            return next((60 + y for y, row in enumerate(white) if all(row[:30]) or all(row[-30:])), None)

        y = wait_for(field, "the field of the node")
        xdotool("mousemove", 150, y + 4, "sleep", 0.3, "click", 1, "key", "ctrl+a", "type", text)
        xdotool("key", "Return", "sleep", 0.5)

    def saved(self, path):
        """What rviz writes on Ctrl+S."""
        os.remove(path)
        xdotool("key", "ctrl+s")
        wait_for(lambda: os.path.exists(path) and os.path.getsize(path) > 0, "rviz to save its configuration")
        with open(path) as file:
            return wait_for(lambda: file.seek(0) == 0 and yaml.safe_load(file), "its configuration")["Panels"][0]

    def test_the_panel_is_given_another_node(self):
        left, right = self.forks
        path = self.start_rviz("left/manipulation")
        wait_for(lambda: "/rviz" in listeners("/left/manipulation/fork"), "the panel to listen")
        switch_torsion(left)
        self.assertTrue(right.next().torsion_on)
        switched = left.last.torsion_on
        self.type_node("/right/bench")
        wait_for(lambda: "/rviz" in listeners("/right/bench/fork"), "the panel to listen to the other node")
        wait_for(lambda: "/rviz" not in listeners("/left/manipulation/fork"), "the panel to leave the first node")
        switch_torsion(right)
        self.assertEqual(left.next().torsion_on, switched)
        self.type_node("no name!")
        self.assertEqual(self.saved(path)["Node"], "/right/bench")
        self.assertIn("/rviz", listeners("/right/bench/fork"))


if __name__ == "__main__":
    rospy.init_node("rviz_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "rviz_test", "__main__", sys.argv)
