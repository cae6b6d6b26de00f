"""Shared by the integration tests: a hand on its own clock, and waiting with a deadline."""
import ctypes
import math
import os
import signal
import subprocess
import time
from xmlrpc.client import ServerProxy

import rosbag
import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Joy
from tf2_msgs.msg import TFMessage

DEADLINE = 120.0  # [s] of wall time; far more than anything here takes


def wait_for(condition, what, deadline=DEADLINE):
    """Returns the condition's value as soon as it is true; raises AssertionError after the deadline."""
    end = time.monotonic() + deadline
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.01)
    raise AssertionError("waited %g s in vain for %s" % (deadline, what))


def slave_api(node):
    return ServerProxy(rosgraph.Master(rospy.get_name()).lookupNode(node))


def pid_of(node):
    return slave_api(node).getPid(rospy.get_name())[2]


def recorder_is_connected(namespace=""):
    """Whether the recorder of a bench listens to both topics that a replay needs."""
    try:
        connections = slave_api(namespace + "/manipulation").getBusInfo(rospy.get_name())[2]
    except Exception:  # the node is not there yet
        return False
    recorded = {connection[4] for connection in connections if connection[1] == namespace + "/record"}
    return recorded >= {namespace + "/manipulation/accepted", namespace + "/manipulation/changes"}


def kill_and_wait(node):
    """Kills a node that is started again (`kill -9`); waits until the new one has taken its place."""
    old = pid_of(node)
    os.kill(old, signal.SIGKILL)
    wait_for(lambda: not os.path.exists("/proc/%d" % old), "the node to be gone")

    def new():
        try:
            return pid_of(node) not in (None, old)
        except Exception:  # nobody is there yet
            return False

    wait_for(new, "a new " + node)


class Listener:
    """Collects all messages of a topic."""

    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=1000)

    @property
    def last(self):
        return self.messages[-1] if self.messages else None

    def next(self, condition=lambda message: True, what="a message"):
        """Returns the next message that satisfies the condition."""
        seen = len(self.messages)
        return wait_for(
            lambda: next((m for m in self.messages[seen:] if condition(m)), None),
            "%s on %s" % (what, self.subscriber.name),
        )


class StoppedThread:
    """Stops one thread of a child process, like a debugger, until it is released."""

    SEIZE, INTERRUPT, DETACH, ALL = 0x4206, 0x4207, 17, 0x40000000
    LIBC = ctypes.CDLL(None, use_errno=True)

    def __init__(self, thread):
        self.thread = thread
        self.ask(self.SEIZE)
        self.ask(self.INTERRUPT)
        os.waitpid(self.thread, self.ALL)

    @classmethod
    def named(cls, pid, name):
        def name_of(thread):
            with open("/proc/%d/task/%s/comm" % (pid, thread)) as file:
                return file.read().strip()

        (thread,) = [int(t) for t in os.listdir("/proc/%d/task" % pid) if name_of(t) == name]
        return cls(thread)

    def ask(self, request):
        if self.LIBC.ptrace(request, self.thread, None, None) != 0:
            raise OSError(ctypes.get_errno(), "ptrace")

    def let_go(self):
        if self.thread:
            self.ask(self.DETACH)
        self.thread = None


def services_of_manipulation(kinds):
    """Waits for these services (name -> type) and returns their proxies by name."""
    for name in kinds:
        rospy.wait_for_service("manipulation/" + name, DEADLINE)
    return {name: rospy.ServiceProxy("manipulation/" + name, kind) for name, kind in kinds.items()}


def diagnostic_values(messages, name_part):
    """Key -> value of the newest status whose name contains the part."""
    for message in reversed(messages):
        for status in message.status:
            if name_part in status.name:
                return {v.key: v.value for v in status.values}
    return {}


def diagnostics_listener():
    return Listener("/diagnostics", DiagnosticArray)


def quaternion(axis, angle):
    s = math.sin(0.5 * angle)
    return (axis[0] * s, axis[1] * s, axis[2] * s, math.cos(0.5 * angle))


def product(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


DOWN = (1.0, 0.0, 0.0, 0.0)  # the fork points down


def stylus_transform(stamp, position, rotation):
    transform = TransformStamped()
    transform.header.stamp = stamp
    transform.header.frame_id = "workbench"
    transform.child_frame_id = "stylus"
    p, q = transform.transform.translation, transform.transform.rotation
    p.x, p.y, p.z = position
    q.x, q.y, q.z, q.w = rotation
    return transform


class Hand:
    """A hand that owns the ROS clock: the clock runs, and samples of the stylus come, only while it moves or rests.
    With `followed_by`, topics of `manipulation`, each move ends when these have come to its end,
    however slow the node is.
    """

    STEP = 0.005  # [s] of the clock
    SAMPLE = 4  # steps between samples
    SPEED = 3.0  # of the clock against the wall
    PERIOD = 0.01  # [s] of the node's steps

    def __init__(self, start=100.0, position=(0.0, 0.0, 0.4), rotation=DOWN, followed_by=()):
        self.tick = round(start / self.STEP)
        self.position, self.rotation, self.pressed = position, rotation, False
        self.followed_by = followed_by
        self.clock = rospy.Publisher("/clock", Clock, queue_size=100)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.joy = rospy.Publisher("stylus/joy", Joy, queue_size=100)

    def now(self):
        return rospy.Time.from_sec(self.tick * self.STEP)

    def wait_for_node(self):
        wait_for(
            lambda: self.tf.get_num_connections() > 0
            and self.joy.get_num_connections() > 0
            and self.clock.get_num_connections() > 1,
            "the node to listen",
        )

    def run(self, seconds, samples=True):
        """Advances the clock with the stylus at rest."""
        self.move(self.position, self.rotation, seconds, samples)

    def move(self, position, rotation, seconds, samples=True):
        """Moves at constant speed from the current pose, with normalised interpolation of the rotation."""
        steps = max(1, round(seconds / self.STEP))
        from_position, from_rotation = self.position, self.rotation
        for k in range(1, steps + 1):
            u = k / steps
            u = u * u * (3 - 2 * u)
            self.position = tuple(a + u * (b - a) for a, b in zip(from_position, position))
            q = [a + u * (b - a) for a, b in zip(from_rotation, rotation)]
            norm = math.sqrt(sum(x * x for x in q))
            self.rotation = tuple(x / norm for x in q)
            self.tick += 1
            if samples and self.tick % self.SAMPLE == 0:
                self.send(stylus_transform(self.now(), self.position, self.rotation))
                self.send_button()
            self.clock.publish(Clock(self.now()))
            time.sleep(self.STEP / self.SPEED)
        if samples:
            self.wait_until_followed()

    def wait_until_followed(self):
        """Time that the node reaches: the step before the last sample but one."""
        newest = self.tick // self.SAMPLE * self.SAMPLE
        end = (newest - self.SAMPLE) * self.STEP - self.PERIOD
        now = self.tick * self.STEP  # the clock may have been set back: what is later is from before
        for topic in self.followed_by:
            wait_for(
                lambda: topic.last and end - 1e-6 < topic.last.header.stamp.to_sec() < now + 1e-6,
                "%s to come to the end of the hand's way" % topic.subscriber.name,
            )

    def send(self, transform):
        self.tf.publish(TFMessage([transform]))

    def send_button(self):
        joy = Joy()
        joy.header.stamp = self.now()
        joy.buttons = [1 if self.pressed else 0, 0]
        self.joy.publish(joy)


class Launched:
    """Runs roslaunch; stops it with all its nodes at the end of the block. `output`: a file."""

    def __init__(self, *arguments, environment=None, output=None):
        self.output = output
        self.arguments = ["roslaunch", "spring_workbench", *arguments]
        self.environment = dict(os.environ, **(environment or {}))

    def __enter__(self):
        self.process = subprocess.Popen(self.arguments, env=self.environment, stdout=self.output, stderr=self.output)
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(DEADLINE)
        if rospy.has_param("/manipulation"):
            rospy.delete_param("/manipulation")


def make_bag(path, speed=1.0):
    """A hand that moves down into the box of single_box, grasps and lifts it, carries it 0.2 m along x and holds it
    there."""
    waypoints = [
        (0.0, (0, 0, 0.4)),
        (1.0, (0, 0, 0.22)),
        (1.6, (0, 0, 0.22)),
        (2.6, (0, 0, 0.4)),
        (3.6, (0.2, 0, 0.4)),
        (4.6, (0.2, 0, 0.4)),
    ]
    start = rospy.Time(1000)
    with rosbag.Bag(path, "w") as bag:
        for k in range(int(230 / speed)):
            t = 0.02 * k * speed
            (t0, a), (t1, b) = next(pair for pair in zip(waypoints, waypoints[1:]) if pair[1][0] > t)
            u = (t - t0) / (t1 - t0)
            u = u * u * (3 - 2 * u)
            stamp = start + rospy.Duration.from_sec(0.02 * k)
            position = tuple(x + u * (y - x) for x, y in zip(a, b))
            bag.write("/tf", TFMessage([stylus_transform(stamp, position, DOWN)]), stamp)
            joy = Joy(buttons=[1 if t > 1.2 else 0, 0])
            joy.header.stamp = stamp
            bag.write("/stylus/joy", joy, stamp)
