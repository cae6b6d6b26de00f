#!/usr/bin/python3
"""A ROS master that hangs or dies under a node `manipulation`: the hand and known clients notice nothing, /diagnostics
says it, and the node ends when it is asked to. The master is one of the test's own. MASTER_OUTAGE: how long [s]."""
import os
import signal
import socket
import subprocess
import sys
import time
import unittest

import roslib.packages
import rospkg
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from spring_workbench.msg import ObjectStates
from spring_workbench.srv import SetForkStiffness
from tf2_msgs.msg import TFMessage

from stack import DEADLINE, DOWN, Listener, diagnostic_values, stylus_transform, wait_for

SCENE = os.path.join(rospkg.RosPack().get_path("spring_workbench"), "scenes", "single_box.urdf")
MANIPULATION = roslib.packages.find_node("spring_workbench", "manipulation")
PERIOD = 0.01  # [s] of the samples
OUTAGE = float(os.environ.get("MASTER_OUTAGE", "5"))  # [s]


def free_port():
    with socket.socket() as s:
        s.bind(("", 0))
        return s.getsockname()[1]


class Feeder:
    """Samples of a hand by the wall's clock, and how long what is shown lags behind them."""

    def __init__(self):
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.lags = []
        self.shown = rospy.Subscriber("manipulation/display/objects", ObjectStates, self.on_shown, queue_size=1000)

    def on_shown(self, message):
        self.lags.append(time.time() - message.header.stamp.to_sec())

    def run(self, seconds):
        """The lags of that time, sorted."""
        self.lags = []
        begin = time.time()
        while time.time() < begin + seconds:
            x = 0.02 + 0.05 * (time.time() - begin) / seconds
            self.tf.publish(TFMessage([stylus_transform(rospy.Time.from_sec(time.time()), (x, 0.0, 0.3), DOWN)]))
            time.sleep(PERIOD)
        return sorted(self.lags)


class Master(unittest.TestCase):
    def setUp(self):
        port = free_port()
        self.environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % port)
        self.master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], env=self.environment)
        self.addCleanup(self.end, self.master)
        helper = [sys.executable, __file__, "--client", str(OUTAGE)]
        wait_for(lambda: not socket.socket().connect_ex(("localhost", port)), "the master")
        command = [*MANIPULATION, "_scene:=" + SCENE]
        self.node = subprocess.Popen(command, env=self.environment)
        self.addCleanup(self.end, self.node)
        self.client = subprocess.Popen(
            helper, env=self.environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.addCleanup(self.end, self.client)

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.send_signal(signal.SIGCONT)
            process.kill()
        process.wait()

    def ask(self, word):
        self.client.stdin.write(word + "\n")
        self.client.stdin.flush()
        answer = self.client.stdout.readline().split()
        self.assertTrue(answer, "the client has ended")
        return answer

    def check(self, outage):
        count, before = self.ask("run")
        print("with a master: %s pictures, largest lag %s s" % (count, before))
        outage()
        count, largest = self.ask("run")
        print("without: %s pictures, largest lag %s s" % (count, largest))
        self.assertGreater(int(count), 0.5 * OUTAGE / PERIOD)
        # A node that waits for its master stands still for seconds; on a busy machine pictures are late with one, too.
        self.assertLess(float(largest), 0.4 + 2.0 * float(before))
        self.assertEqual(self.ask("service"), ["True"])
        self.assertEqual(self.ask("diagnostics"), ["True"])
        begin = time.monotonic()
        self.node.send_signal(signal.SIGINT)
        self.node.wait(DEADLINE)
        print("ended in %.2f s" % (time.monotonic() - begin))
        self.assertLess(time.monotonic() - begin, 2.0)

    def test_nothing_is_noticed_while_the_master_hangs(self):
        self.check(lambda: self.master.send_signal(signal.SIGSTOP))

    def test_nothing_is_noticed_without_a_master(self):
        def kill():
            self.master.kill()
            self.master.wait()

        self.check(kill)


def client():
    """In a process of its own, since it has a master of its own: does what it reads."""
    rospy.init_node("client", disable_rostime=True)
    feeder = Feeder()
    diagnostics = Listener("/diagnostics", DiagnosticArray)
    rospy.wait_for_service("manipulation/set_stiffness", DEADLINE)
    service = rospy.ServiceProxy("manipulation/set_stiffness", SetForkStiffness, persistent=True)
    service(stretch=500.0)
    wait_for(lambda: feeder.tf.get_num_connections() > 0 and feeder.shown.get_num_connections() > 0, "the node")
    feeder.run(1.0)
    for line in sys.stdin:
        if line.strip() == "run":
            lags = feeder.run(float(sys.argv[2]))
            print(len(lags), lags[-1], flush=True)
        elif line.strip() == "service":
            print(service(stretch=600.0).success, flush=True)
        else:
            said = wait_for(
                lambda: float(
                    diagnostic_values(diagnostics.messages, "physics loop").get("since the master answered [s]", 0.0)
                )
                > 3.0,
                "the node to say that the master is gone",
            )
            print(said, flush=True)


if __name__ == "__main__":
    if "--client" in sys.argv:
        client()
    else:
        rostest.rosrun("spring_workbench", "master_test", Master, sys.argv)
