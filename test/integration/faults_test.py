#!/usr/bin/python3
"""The stack under faults: nodes killed and restarted, a subscriber that does not read, a full disk, a stopped
processor, a flood of service calls. The hand owns the ROS clock (stack.Hand)."""
import io
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from roscpp.srv import SetLoggerLevel
from rosgraph.names import ns_join
from spring_workbench.msg import ForkState, ObjectStates, StepReport
from spring_workbench.srv import (
    Calibrate,
    LoadScene,
    Release,
    SelectTool,
    SetClutch,
    SetForkDamping,
    SetForkDofs,
    SetForkStiffness,
    SetIntegrator,
)
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from stack import (
    DEADLINE,
    DOWN,
    Hand,
    Launched,
    Listener,
    StoppedThread,
    diagnostic_values,
    diagnostics_listener,
    kill_and_wait,
    pid_of,
    slave_api,
    stylus_transform,
    wait_for,
)

BOX = os.path.join(rospkg.RosPack().get_path("spring_workbench"), "scenes", "single_box.urdf")
NODE = roslib.packages.find_node("spring_workbench", "manipulation")[0]
SCENE = "scene:=package://spring_workbench/scenes/single_box.urdf"
DEAF = "/manipulation/markers to /deaf"
STACK = ["workbench.launch", SCENE, "tracker:=false", "rviz:=false", "calibrate:=none", "respawn:=true"]
SERVICES = {
    "set_dofs": SetForkDofs,
    "set_stiffness": SetForkStiffness,
    "set_damping": SetForkDamping,
    "reset": Trigger,
    "set_integrator": SetIntegrator,
    "select_tool": SelectTool,
    "calibrate": Calibrate,
    "clutch": SetClutch,
    "release": Release,
    "load_scene": LoadScene,
}


def memory_of(pid):
    """Resident memory of a process [MB]."""
    with open("/proc/%d/statm" % pid) as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6


class Written(TFMessage):
    """A message that is serialised once, so that many can be sent fast."""

    def __init__(self, message):
        super().__init__()
        buffer = io.BytesIO()
        message.serialize(buffer)
        self.bytes = buffer.getvalue()

    def serialize(self, buff):
        buff.write(self.bytes)


class UnreadLog:
    """A full pipe without a reader: a write to its `end` blocks."""

    def __init__(self):
        self.begin, end = os.pipe()
        os.set_blocking(end, False)
        for size in (4096, 1):
            try:
                while True:
                    os.write(end, b"." * size)
            except BlockingIOError:
                pass
        os.set_blocking(end, True)
        self.end = open(end, "wb")


class Faults(unittest.TestCase):
    def setUp(self):
        self.objects = Listener("manipulation/objects", ObjectStates)
        self.fork = Listener("manipulation/fork", ForkState)
        self.steps = Listener("manipulation/steps", StepReport)
        self.stack = Launched(*STACK)
        self.stack.__enter__()
        self.addCleanup(self.stack.__exit__)
        self.hand = Hand()
        self.hand.wait_for_node()
        self.keep_going()

    def tearDown(self):
        for listener in [self.objects, self.fork, self.steps]:
            listener.subscriber.unregister()

    def call(self, service, *arguments):
        rospy.wait_for_service("manipulation/" + service, DEADLINE)
        return rospy.ServiceProxy("manipulation/" + service, SERVICES[service])(*arguments)

    def keep_going(self, seconds=0.3):
        """Lets simulated time advance with the hand at rest until the node has sent something new."""
        seen = len(self.objects.messages), len(self.fork.messages)
        end = time.monotonic() + DEADLINE
        while not (len(self.objects.messages) > seen[0] and len(self.fork.messages) > seen[1]):
            assert time.monotonic() < end, "the node says nothing"
            self.hand.run(seconds)

    def box(self):
        return self.objects.last.objects[0]

    def carry_off(self):
        """Grasps the box, lifts it, and brings it 0.1 m along x."""
        self.hand.move((0.03, 0.0, 0.22), DOWN, 0.8)
        self.hand.pressed = True
        self.hand.run(0.3)
        self.hand.move((0.03, 0.0, 0.4), DOWN, 0.8)
        self.hand.move((0.13, 0.0, 0.4), DOWN, 0.8)
        self.hand.run(1.0)
        self.assertTrue(self.box().held)

    def set_down(self):
        self.hand.move((0.13, 0.0, 0.215), DOWN, 0.8)
        self.hand.pressed = False
        self.hand.run(0.3)
        self.hand.move((0.13, 0.0, 0.4), DOWN, 0.5)
        self.hand.run(2.0)
        self.keep_going()
        self.assertFalse(self.box().held)

    def log_errors_only(self):
        """Prevents hundreds of refused calls from hiding a failure."""
        rospy.ServiceProxy("manipulation/set_logger_level", SetLoggerLevel)("ros.spring_workbench", "error")

    def wait_for_checkpoint(self):
        """Waits until the checkpoint is up to date: time is stopped, and it has not changed for three periods."""
        last, since = None, time.monotonic()

        def settled():
            nonlocal last, since
            checkpoint = rospy.get_param("/manipulation/resume", None)
            if checkpoint != last:
                last, since = checkpoint, time.monotonic()
            return last and time.monotonic() - since > 1.5

        wait_for(settled, "the checkpoint")

    def kill_and_wait(self):
        kill_and_wait("/manipulation")
        self.hand.wait_for_node()
        self.hand.pressed = False
        self.hand.send_button()  # before the new node has heard of the clock: it begins no time of its own
        self.keep_going()

    def test_a_killed_node_comes_back_as_it_was(self):
        self.assertTrue(self.call("set_stiffness", 1500.0, 700.0, 3.0, 0).success)
        self.assertTrue(self.call("set_damping", 0.5, 0.6, 0.7, "", 0).success)
        self.assertTrue(self.call("set_dofs", True, True, False, 0).success)
        self.assertTrue(self.call("set_integrator", "rosenbrock", 0.01, 0.0).success)
        self.carry_off()
        self.set_down()
        before = self.box().pose.position
        self.assertGreater(before.x, 0.08)
        self.assertTrue(self.call("select_tool", "direct", 0).success)
        self.keep_going()
        self.wait_for_checkpoint()
        self.kill_and_wait()
        self.hand.run(1.0)
        self.keep_going()
        after = self.box()
        for axis in "xyz":
            self.assertAlmostEqual(getattr(after.pose.position, axis), getattr(before, axis), delta=1e-4)
        self.assertFalse(after.held)
        self.assertEqual(self.fork.last.tool, "direct")
        self.assertTrue(self.call("select_tool", "spring_fork", 0).success)
        self.keep_going()
        fork = self.fork.last
        self.assertEqual((fork.stretch_on, fork.bend_on, fork.torsion_on), (True, True, False))
        self.assertEqual((fork.stretch_stiffness, fork.bend_stiffness, fork.torsion_stiffness), (1500.0, 700.0, 3.0))
        self.assertEqual(
            (fork.stretch_damping_ratio, fork.bend_damping_ratio, fork.torsion_damping_ratio), (0.5, 0.6, 0.7)
        )
        self.assertEqual(fork.integrator, "rosenbrock")

    def test_of_a_checkpoint_that_cannot_be_used_nothing_is(self):
        """A truncated text, numbers that do not match the hash, the wrong scene."""
        for what, spoil in [
            ("length", lambda text: text[: len(text) // 2]),
            ("numbers", lambda text: text.replace("0", "1")),
            ("scene", lambda text: re.sub(r"(\nscene: .*)single_box", r"\1mini_world", text)),
        ]:
            with self.subTest(what=what):
                self.keep_going()
                before = self.fork.last
                self.assertTrue(self.call("set_stiffness", 1500.0, 700.0, 3.0, 0).success)
                self.assertTrue(self.call("set_integrator", "rosenbrock", 0.01, 0.0).success)
                self.wait_for_checkpoint()
                text = rospy.get_param("/manipulation/resume")
                self.assertNotEqual(text, spoil(text))
                rospy.set_param("/manipulation/resume", spoil(text))
                self.kill_and_wait()
                after = self.fork.last
                self.assertEqual((after.tool, after.integrator), (before.tool, before.integrator))
                self.assertEqual(after.stretch_stiffness, before.stretch_stiffness)

    def test_what_was_held_when_the_node_was_killed_falls_from_there(self):
        self.carry_off()
        self.wait_for_checkpoint()
        x = self.box().pose.position.x
        self.kill_and_wait()
        self.hand.run(3.0)
        self.keep_going()
        box = self.box()
        self.assertFalse(box.held)
        self.assertAlmostEqual(box.pose.position.x, x, delta=0.02)
        self.assertAlmostEqual(box.pose.position.z, 0.02, delta=1e-3)

    def test_a_node_that_ends_in_order_leaves_nothing_behind(self):
        wait_for(lambda: rospy.has_param("/manipulation/resume"), "the checkpoint")
        os.kill(pid_of("/manipulation"), signal.SIGINT)
        wait_for(lambda: not rospy.has_param("/manipulation/resume"), "the checkpoint to be deleted")

    def deaf(self, topic, kind):
        """The connection of a subscriber that does not read."""
        name = ns_join("/manipulation", topic)
        protocol = slave_api("/manipulation").requestTopic("/deaf", name, [["TCPROS"]])[2]
        connection = socket.create_connection((protocol[1], protocol[2]))
        self.addCleanup(connection.close)
        fields = {"callerid": "/deaf", "topic": name, "type": kind._type, "md5sum": kind._md5sum}
        fields = [("%s=%s" % field).encode() for field in fields.items()]
        header = b"".join(len(f).to_bytes(4, "little") + f for f in fields)
        connection.sendall(len(header).to_bytes(4, "little") + header)
        return connection

    def test_a_subscriber_that_does_not_read_holds_nobody_up(self):
        """It subscribes to the largest topics and never reads: the node continues for the others, with bounded
        memory."""
        for topic, kind in [("objects", ObjectStates), ("fork", ForkState)]:
            self.deaf(topic, kind).setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.hand.run(3.0)
        pid = pid_of("/manipulation")
        early, seen = memory_of(pid), len(self.objects.messages)
        self.hand.run(20.0)
        self.keep_going()
        self.assertGreater(len(self.objects.messages) - seen, 500)
        self.assertLess(memory_of(pid), early + 30.0)

    def test_messages_that_are_not_sent_are_counted(self):
        """A subscriber reads nothing at first, then all that is left for it: the others are those that are counted."""
        diagnostics = diagnostics_listener()
        self.addCleanup(diagnostics.subscriber.unregister)
        unsent = lambda: int(diagnostic_values(diagnostics.messages, "messages lost").get(DEAF, 0))
        connection = self.deaf("markers", MarkerArray)
        node = slave_api("/manipulation")
        numbers = lambda: [info[0] for info in node.getBusInfo("/faults")[2] if info[1] == "/deaf"]
        (number,) = wait_for(numbers, "the connection")

        def queued():
            """Number of messages for the subscriber so far."""
            topics = node.getBusStats("/faults")[0]
            return next(link[3] for _, links in topics for link in links if link[0] == number)

        end = time.monotonic() + DEADLINE
        while unsent() < 100:
            self.assertLess(time.monotonic(), end, "no message is counted: %d of %d" % (unsent(), queued()))
            self.assertLessEqual(unsent(), queued())
            self.hand.run(0.5)
        received = 0

        def read():
            nonlocal received
            stream = connection.makefile("rb")
            stream.read(int.from_bytes(stream.read(4), "little"))  # the header of the connection
            for length in iter(lambda: stream.read(4), b""):
                stream.read(int.from_bytes(length, "little"))
                received += 1

        reader = threading.Thread(target=read)
        reader.start()
        self.addCleanup(reader.join)
        self.addCleanup(connection.shutdown, socket.SHUT_RDWR)
        complete = lambda: abs(queued() - received - unsent()) <= 0.02 * unsent()
        wait_for(complete, "what was not sent to be counted")
        print("%d for it, %d received, %d counted as not sent" % (queued(), received, unsent()))

    def test_after_a_stopped_processor_time_is_the_hands_again(self):
        pid = pid_of("/manipulation")
        self.hand.run(1.0)
        os.kill(pid, signal.SIGSTOP)
        seen = len(self.steps.messages)
        self.hand.run(2.0)
        os.kill(pid, signal.SIGCONT)
        self.keep_going()
        wait_for(
            lambda: self.steps.messages[seen:]
            and self.objects.last.header.stamp.to_sec() > self.hand.now().to_sec() - 0.5,
            "simulated time to come up with the hand's",
        )
        self.assertEqual(sum(m.steps_rejected for m in self.steps.messages[seen:]), 0)

    def second_node(self, log):
        """Another node with its own poses, remapped from /tf to /second/tf; the hand moves it instead of the first."""
        poses = Listener("/second/manipulation/objects", ObjectStates)
        self.addCleanup(poses.subscriber.unregister)
        command = [NODE, "__ns:=/second", "/tf:=/second/tf", "_scene:=" + BOX]
        node = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=log)
        self.addCleanup(node.wait)
        self.addCleanup(node.kill)
        transforms = ["/second/tf", "tf2_msgs/TFMessage"]
        wait_for(lambda: transforms in rospy.get_published_topics(), "the second node's connection with itself")
        self.hand.tf = rospy.Publisher("/second/tf", TFMessage, queue_size=None, tcp_nodelay=True)  # it loses nothing
        wait_for(lambda: self.hand.tf.get_num_connections() > 0, "the second node to listen")
        return node, poses

    def end(self, node):
        node.send_signal(signal.SIGINT)
        self.assertEqual(node.wait(DEADLINE), 0)

    def follow(self, poses):
        """Moves until current poses arrive from a node."""
        begin, end = self.hand.now(), time.monotonic() + DEADLINE
        while not (poses.last and poses.last.header.stamp > begin):
            self.assertLess(time.monotonic(), end, "the second node follows no hand")
            self.hand.run(0.3)

    def warn(self):
        """Makes the second node log a warning."""
        unknown = stylus_transform(self.hand.now(), (0.0, 0.0, 0.4), DOWN)
        unknown.header.frame_id = "nowhere"
        self.hand.tf.publish(TFMessage([unknown]))

    def test_a_log_that_nobody_reads_holds_nobody_up(self):
        """As with a terminal that was stopped by Ctrl-S: the hand is followed, and the node can be stopped."""
        log = UnreadLog()
        node, poses = self.second_node(log.end)
        for _ in range(3):
            self.warn()
            self.follow(poses)
        self.end(node)

    def lost(self, diagnostics):
        """Number of messages on /second/tf that the second node says it has lost."""
        return diagnostic_values(diagnostics.messages, "/second/manipulation: messages lost").get("/second/tf")

    def test_no_message_counts_as_lost_because_the_node_sends_on_the_topic_itself(self):
        """Its own messages reach it among those of others; a full queue is far away."""
        diagnostics, frames = diagnostics_listener(), Listener("/second/tf", TFMessage)
        for listener in (diagnostics, frames):
            self.addCleanup(listener.subscriber.unregister)
        node, poses = self.second_node(subprocess.DEVNULL)
        self.follow(poses)
        is_own = lambda m: m._connection_header["callerid"] == "/second/manipulation"
        noise, over = Written(TFMessage([TransformStamped(child_frame_id="noise")])), threading.Event()

        def make_noise():
            while not over.wait(1e-3):
                for _ in range(3):
                    self.hand.tf.publish(noise)

        other = threading.Thread(target=make_noise)
        other.start()
        self.addCleanup(other.join)
        self.addCleanup(over.set)
        end = time.monotonic() + DEADLINE
        while sum(is_own(m) for m in frames.messages) < 200:
            self.assertLess(time.monotonic(), end, "the node sends nothing")
            self.hand.run(0.3)
        over.set()
        said = len(diagnostics.messages)
        wait_for(lambda: len(diagnostics.messages) > said + 1, "the count after that")
        self.assertEqual(self.lost(diagnostics), "0")
        self.end(node)

    def test_messages_lost_at_a_full_queue_are_counted(self):
        """While its callback thread is stopped, all but the newest messages are dropped, and each is counted. They come
        from a sender that is not the newest."""
        count, queue = 10000, 2000
        diagnostics = diagnostics_listener()
        self.addCleanup(diagnostics.subscriber.unregister)
        node, poses = self.second_node(subprocess.DEVNULL)

        told = lambda: self.lost(diagnostics)

        def senders():
            connections = slave_api("/second/manipulation").getBusInfo("/faults")[2]
            return sum(direction == "i" and topic == "/second/tf" for _, _, direction, _, topic, *_ in connections)

        self.follow(poses)
        wait_for(lambda: told() == "0", "nothing to be lost yet")
        before = senders()
        other = subprocess.Popen(["rostopic", "pub", "-l", "/second/tf", "tf2_msgs/TFMessage", "{}"])
        self.addCleanup(other.wait)
        self.addCleanup(other.kill)
        wait_for(lambda: senders() > before, "another sender")
        self.follow(poses)
        callbacks = StoppedThread.named(node.pid, "input")
        self.addCleanup(callbacks.let_go)
        noise = Written(TFMessage([TransformStamped(child_frame_id="noise")]))
        for _ in range(count):
            self.hand.tf.publish(noise)
        wait_for(lambda: int(told()) >= count - queue, "the lost messages to be counted")
        print("%d sent, %s lost" % (count, told()))
        self.assertLess(int(told()), count - queue + 100)  # some of the hand's may have been waiting
        callbacks.let_go()
        self.follow(poses)
        self.end(node)

    def test_a_full_disk_under_a_recording(self):
        with tempfile.TemporaryDirectory() as folder:
            recording = subprocess.Popen(
                ["bash", "-c", "ulimit -f 16; exec rosbag record -a -O %s/r.bag" % folder],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            end = time.monotonic() + DEADLINE
            while recording.poll() is None:
                self.assertLess(time.monotonic(), end, "16 KiB are not full yet")
                self.hand.run(0.5)
            self.keep_going()

    def test_a_flood_of_calls_while_holding(self):
        """Calls all services that do not move the held object, from four clients at once."""
        self.carry_off()
        calls = [
            ("set_stiffness", (2000.0, 500.0, 5.0, 0)),
            ("set_damping", (1.0, 0.9, 0.8, "per_dof", 0)),
            ("set_dofs", (True, True, True, 0)),
            ("set_integrator", ("exponential", 0.02, 0.0)),
            ("set_stiffness", (-1.0, 0.0, 0.0, 0)),
        ]
        answered, broken = [0] * 4, []

        def flood(client):
            try:
                proxies = {
                    name: rospy.ServiceProxy("manipulation/" + name, SERVICES[name], persistent=True)
                    for name, _ in calls
                }
                for i in range(300):
                    name, arguments = calls[(i + client) % len(calls)]
                    if proxies[name](*arguments).success == (arguments[:1] != (-1.0,)):
                        answered[client] += 1
            except Exception as error:  # pylint: disable=broad-except
                broken.append(error)

        self.log_errors_only()
        clients = [threading.Thread(target=flood, args=(client,)) for client in range(4)]
        seen, told = len(self.objects.messages), len(self.steps.messages)
        begin = time.monotonic()
        for client in clients:
            client.start()
        while any(client.is_alive() for client in clients):
            self.hand.run(0.2)
        print("%.0f calls a second" % (1200.0 / (time.monotonic() - begin)))
        self.keep_going()
        self.assertEqual(broken, [])
        self.assertEqual(answered, [300] * 4)
        self.assertTrue(self.box().held)
        heights = [m.objects[0].pose.position.z for m in self.objects.messages[seen:]]
        self.assertLess(max(heights) - min(heights), 1e-3)
        wait_for(
            lambda: self.objects.last.header.stamp.to_sec() > self.hand.now().to_sec() - 0.5,
            "simulated time to come up with the hand's",
        )
        self.assertGreater(len(self.steps.messages), told)
        self.assertEqual(sum(m.steps_rejected for m in self.steps.messages[told:]), 0)

    def test_all_services_at_once(self):
        """Four clients call all services in different orders: each call is answered, and the node is unaffected
        afterwards."""
        calls = [
            ("select_tool", ("direct", 0)),
            ("select_tool", ("spring_fork", 2)),
            ("set_dofs", (True, False, True, 0)),
            ("set_stiffness", (900.0, 500.0, 5.0, 0)),
            ("set_damping", (1.0, 0.9, 0.8, "per_dof", 0)),
            ("calibrate", (1,)),
            ("set_integrator", ("implicit_euler", 0.02, 0.0)),
            ("reset", ()),
            ("release", (2,)),
            ("clutch", (False, 0)),
            ("load_scene", ("package://spring_workbench/scenes/single_box.urdf",)),
        ]
        self.carry_off()
        node, answers, broken = pid_of("/manipulation"), [0] * 4, []

        def flood(client):
            try:
                proxies = {name: rospy.ServiceProxy("manipulation/" + name, SERVICES[name]) for name, _ in calls}
                for i in range(40):
                    name, arguments = calls[(i * (client + 3) + client) % len(calls)]
                    answer = proxies[name](*arguments)
                    answers[client] += answer.success or name in ("calibrate", "release")  # where nothing is held
            except Exception as error:  # pylint: disable=broad-except
                broken.append(error)

        self.log_errors_only()
        clients = [threading.Thread(target=flood, args=(client,)) for client in range(4)]
        for client in clients:
            client.start()
        while any(client.is_alive() for client in clients):
            self.hand.run(0.2)
        self.assertEqual(broken, [])
        self.assertEqual(answers, [40] * 4)
        self.assertEqual(pid_of("/manipulation"), node)
        self.hand.pressed = False
        for service, arguments in [
            ("load_scene", calls[-1][1]),
            ("select_tool", ("spring_fork", 0)),
            ("set_dofs", (True, True, True, 0)),
        ]:
            self.assertTrue(self.call(service, *arguments).success)
        self.hand.run(0.5)
        self.carry_off()


if __name__ == "__main__":
    rospy.init_node("faults_test")
    rostest.rosrun("spring_workbench", "faults_test", Faults, sys.argv)
