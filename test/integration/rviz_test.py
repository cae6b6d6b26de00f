#!/usr/bin/python3
"""rviz with the panel, the fork's display and the marker of the mouse, operated by clicks and drags on a virtual
display."""
import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

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


@unittest.skipUnless(os.path.exists(PLUGINS), "the rviz plugins were not built")
@unittest.skipUnless(
    all(map(shutil.which, ["Xvfb", "openbox", "xdotool", "import"])),
    "Xvfb, openbox, xdotool or ImageMagick is not installed",
)
class Rviz(unittest.TestCase):
    def setUp(self):
        rospy.set_param("/use_sim_time", False)
        self.fork, self.joy = Listener("manipulation/fork", ForkState), Listener("stylus/joy", Joy)
        self.objects = Listener("manipulation/objects", ObjectStates)
        stack = contextlib.ExitStack()
        self.addCleanup(stack.close)
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        os.environ.update(stack.enter_context(screen(*SIZE)))
        stack.enter_context(window_manager())
        stack.enter_context(
            Launched(
                "workbench.launch",
                "input:=mouse",
                "rviz_config:=" + config(folder),
                "scene:=package://spring_workbench/scenes/single_box.urdf",
                "settings:=" + PACKAGE + "/config/demo_fork.yaml",
            )
        )
        subscribers = lambda: dict(rosgraph.Master("/test").getSystemState()[1])
        wait_for(lambda: "/rviz" in subscribers().get("/manipulation/fork", []), "the panel to listen")
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
        box_column = 16
        self.assertTrue(self.fork.next().torsion_on)
        for y in range(84, 300, 12):  # down the column of switches
            xdotool("mousemove", box_column, y, "sleep", 0.1, "click", 1)
            with contextlib.suppress(AssertionError):  # most of the column is no switch of torsion
                wait_for(lambda: not self.fork.last.torsion_on, "torsion off", 1.5)
                break
        self.assertFalse(self.fork.next().torsion_on)
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
        self.assertIn("tolerance 1e-05 m", message)

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


if __name__ == "__main__":
    rospy.init_node("rviz_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "rviz_test", Rviz, sys.argv)
