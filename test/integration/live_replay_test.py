#!/usr/bin/python3
"""A live run is its replay: two hands, what two machines measure, services and live settings changed at random,
recorded with rosbag; what was committed equals what `replay` makes of the bag, bit by bit, and the state's hash at
every comparison. `replay` makes each change again at its time, and it leads to the recorded state. LIVE_SEEDS: how
many."""
import csv
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import rosbag
import roslib.packages
import rospkg
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3, Wrench, WrenchStamped
from sensor_msgs.msg import Joy
from spring_workbench.msg import Accepted, Change, ObjectStates
from spring_workbench.srv import (
    Calibrate,
    EditObject,
    LoadScene,
    Release,
    SelectTool,
    SetClutch,
    SetForkDamping,
    SetForkDofs,
    SetForkStiffness,
    SetIntegrator,
    SetIntegratorRequest,
)
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from stack import DEADLINE, DOWN, Listener, services_of_manipulation, stylus_transform, wait_for

SEEDS = int(os.environ.get("LIVE_SEEDS", "3"))
DURATION = 6.0  # [s] of a run
PACKAGE = rospkg.RosPack().get_path("spring_workbench")
BRICK = "package://spring_workbench/test/integration/data/brick.urdf"
SCENE = os.path.join(PACKAGE, "scenes", "single_box.urdf")
MANIPULATION = roslib.packages.find_node("spring_workbench", "manipulation")
REPLAY = roslib.packages.find_node("spring_workbench", "replay")
TOPICS = ["/manipulation/" + name for name in ("accepted", "changes", "objects")]


class TwoHands:
    """Two hands by the wall's clock, each with its own rate: they reach for the box, lift it, shake it, let go."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.joy = [rospy.Publisher(name, Joy, queue_size=100) for name in ("stylus/joy", "stylus_2/joy")]
        self.sensors = [
            rospy.Publisher("manipulation/external_wrench" + ending, WrenchStamped, queue_size=100)
            for ending in ("", "_2")
        ]
        self.rates = [self.random.choice([30.0, 60.0, 120.0]) for _ in range(2)]
        self.goal = [self.new_goal(hand) for hand in range(2)]
        self.position = list(self.goal)
        self.next = [time.time()] * 2
        self.pressed, self.clutch = [False, False], [False, False]

    def new_goal(self, hand):
        reach = self.random.random() < 0.6
        return [
            (0.02 if hand == 0 else -0.02) + self.random.gauss(0.0, 0.005 if reach else 0.05),
            self.random.gauss(0.0, 0.005 if reach else 0.05),
            0.22 if reach else self.random.uniform(0.25, 0.45),
        ]

    def step(self):
        now = time.time()
        for hand in range(2):
            if now < self.next[hand]:
                continue
            dt = 1.0 / self.rates[hand]
            self.next[hand] = max(self.next[hand] + dt, now)
            if self.random.random() < 1.5 * dt:
                self.goal[hand] = self.new_goal(hand)
            if self.random.random() < 1.5 * dt:
                self.pressed[hand] = not self.pressed[hand]
            silent = self.random.random() < 0.05
            share = min(1.0, 6.0 * dt)
            self.position[hand] = [p + share * (g - p) for p, g in zip(self.position[hand], self.goal[hand])]
            stamp = rospy.Time.from_sec(now)
            if silent:
                continue
            transform = stylus_transform(stamp, self.position[hand], DOWN)
            if hand == 1:
                transform.child_frame_id = "stylus_2"
            self.tf.publish(TFMessage([transform]))
            if self.random.random() < dt:
                self.clutch[hand] = not self.clutch[hand]
            buttons = [self.pressed[hand], self.random.random() < 0.003, self.clutch[hand]]
            joy = Joy(buttons=[int(down) for down in buttons])
            joy.header.stamp = stamp
            self.joy[hand].publish(joy)
            if self.random.random() < 0.6:
                self.measure(hand, stamp)

    def measure(self, hand, stamp):
        """The force sensor of a machine that this hand drives."""
        measured = WrenchStamped()
        measured.header.stamp = stamp
        measured.header.frame_id = self.random.choice(["world", "fork_tip" if hand == 0 else "fork_tip_2"])
        force = [self.random.gauss(0.0, 2.0) for _ in range(3)]
        measured.wrench = Wrench(Vector3(*force), Vector3(0.0, 0.0, self.random.gauss(0.0, 0.02)))
        self.sensors[hand].publish(measured)


class Services:
    def __init__(self, seed):
        self.random = random.Random(1000 + seed)
        self.call = services_of_manipulation(
            {
                "select_tool": SelectTool,
                "set_dofs": SetForkDofs,
                "set_stiffness": SetForkStiffness,
                "set_damping": SetForkDamping,
                "set_integrator": SetIntegrator,
                "load_scene": LoadScene,
                "reset": Trigger,
                "undo": Trigger,
                "edit_object": EditObject,
                "release": Release,
                "calibrate": Calibrate,
                "clutch": SetClutch,
            }
        )
        self.panel = Client("manipulation/live", timeout=DEADLINE)

    def add_or_remove(self):
        name, edit = "brick_%d" % self.random.randint(1, 3), self.call["edit_object"]
        place = Pose(Point(self.random.uniform(-0.2, 0.2), 0.15, 0.3), Quaternion(0.0, 0.0, 0.0, 1.0))
        if not edit(action="add", name=name, urdf=BRICK, pose=place).success:
            edit(action="remove", name=name)

    def one(self):
        r, call = self.random, self.call
        r.choice(
            [
                lambda: call["select_tool"](
                    tool=r.choice(["spring", "spring_fork", "spring_probe", "direct", "ray"]), stylus=r.randint(1, 2)
                ),
                lambda: call["set_dofs"](
                    stretch=r.random() < 0.7, bend=r.random() < 0.7, torsion=r.random() < 0.7, stylus=r.randint(0, 2)
                ),
                lambda: call["set_stiffness"](
                    stretch=r.uniform(100.0, 2000.0), bend=r.uniform(50.0, 500.0), stylus=r.randint(0, 2)
                ),
                lambda: call["set_integrator"](
                    name=r.choice(["exponential", "rk4"]), tolerance=SetIntegratorRequest.KEEP_TOLERANCE
                ),
                lambda: call["set_damping"](
                    law=r.choice(["", "per_dof"]), stretch=r.random(), bend=r.random(), torsion=r.random()
                ),
                lambda: self.panel.update_configuration(
                    {"stretch": r.random() < 0.7, "bend_stiffness": r.uniform(50.0, 500.0)}
                ),
                lambda: call["release"](stylus=r.randint(0, 2)),
                lambda: call["calibrate"](stylus=r.randint(0, 2)),
                lambda: call["clutch"](on=r.random() < 0.5, stylus=r.randint(0, 2)),
                lambda: call["edit_object"](action="mass", name="box", mass=r.choice([0.0, r.uniform(0.5, 3.0)])),
                lambda: call["edit_object"](action="friction", name="box", friction=r.uniform(0.0, 1.0)),
                lambda: self.add_or_remove(),
                lambda: call["undo"](),
                call["reset"] if r.random() < 0.3 else call["release"],
                (lambda: call["load_scene"](scene=SCENE)) if r.random() < 0.3 else call["calibrate"],
            ]
        )()


def end(process):
    process.send_signal(signal.SIGINT)
    process.wait(DEADLINE)


class LiveReplay(unittest.TestCase):
    def record(self, seed, folder):
        """Path of the bag of a run."""
        r = random.Random(seed)
        options = [
            "scene:=" + SCENE,
            "contact:=" + ("dynamic" if seed % 2 else "stop"),
            "rate:=%d" % r.choice([50, 1000]),
            "display_latency:=%g" % r.choice([0.0, 0.03]),
        ]
        print("seed %d: %s" % (seed, " ".join(options[1:])))
        bag = os.path.join(folder, "run.bag")
        node = subprocess.Popen([*MANIPULATION, *("_" + option for option in options)])
        services = Services(seed)
        recorder = subprocess.Popen(["rosbag", "record", "-O", bag, "--buffsize=0", *TOPICS])
        changes = Listener("manipulation/changes", Change)
        listener = rospy.Subscriber("manipulation/accepted", Accepted, lambda _: None)
        hands = TwoHands(seed)
        wait_for(lambda: hands.tf.get_num_connections() > 0 and changes.last, "the journal to begin")
        wait_for(lambda: os.path.exists(bag + ".active"), "rosbag to record")
        begin, next_call = time.time(), time.time() + 1.0
        while time.time() < begin + DURATION:
            hands.step()
            if time.time() > next_call:
                services.one()
                next_call = time.time() + r.uniform(0.1, 0.8)
            time.sleep(0.002)
        seen = len(changes.messages)
        wait_for(lambda: any(not m.state for m in changes.messages[seen:]), "a comparison after the end")
        listener.unregister()
        changes.subscriber.unregister()
        end(recorder)
        end(node)
        return bag, options[1]

    def replay(self, bag, contact, folder):
        """Time [s] and object -> poses and twists, several at a change; the summary."""
        out = os.path.join(folder, "run.csv")
        command = [*REPLAY, "--scene", SCENE, "--bag", bag, "--out", out]
        done = subprocess.run([*command, "--set", contact.replace(":=", "=")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = {}
        with open(out) as file:
            for row in csv.DictReader(file):
                numbers = [float(row[key]) for key in "x y z qx qy qz qw vx vy vz wx wy wz".split()]
                rows.setdefault((float(row["t"]), row["object"]), []).append(numbers)
        return rows, json.loads(done.stdout.splitlines()[-1])

    def check(self, seed):
        with tempfile.TemporaryDirectory() as folder:
            bag, contact = self.record(seed, folder)
            rows, summary = self.replay(bag, contact, folder)
            with rosbag.Bag(bag) as recorded:
                messages = {topic: [m.message for m in recorded.read_messages(topic)] for topic in TOPICS}
        zeros = {m.header.stamp.to_nsec() - round(m.time * 1e9) for m in messages[TOPICS[0]] if m.kind == Accepted.POSE}
        # Several where time was left out, and by rounding of one nanosecond.
        by_stamp = {}
        for (t, name), states in rows.items():
            for zero in zeros:
                by_stamp.setdefault((zero + round(t * 1e9), name), []).extend(states)
        stamps = [m.header.stamp.to_nsec() for m in messages[TOPICS[1]]]
        replayed = {}  # where no hand is known, the stamp is the clock's: the state is that after a change
        for (_, name), states in rows.items():
            replayed.setdefault(name, set()).update(tuple(state) for state in states)
        same = outside = waiting = 0
        for message in messages[TOPICS[2]]:
            for state in message.objects:
                stamp = message.header.stamp.to_nsec()
                found = by_stamp.get((stamp, state.name))
                if found is None and not stamps[0] < stamp < stamps[-1]:
                    outside += 1  # before the journal, or after it
                    continue
                p, q, v, w = state.pose.position, state.pose.orientation, state.twist.linear, state.twist.angular
                sign = -1.0 if q.w < 0.0 else 1.0
                numbers = [p.x, p.y, p.z, sign * q.x, sign * q.y, sign * q.z, sign * q.w, v.x, v.y, v.z, w.x, w.y, w.z]
                if found is None:
                    self.assertIn(tuple(numbers), replayed[state.name], "seed %d at %d" % (seed, stamp))
                    self.assertFalse(any(numbers[7:]), "seed %d at %d: moves with no hand" % (seed, stamp))
                    waiting += 1
                    continue
                self.assertIn(numbers, found, "seed %d at %d" % (seed, stamp))
                same += 1
        comparisons = sum(not m.state for m in messages[TOPICS[1]])
        held = sum(m.objects[0].held for m in messages[TOPICS[2]])
        wrenches = sum(m.kind == Accepted.EXTERNAL_WRENCH for m in messages[TOPICS[0]])
        print(
            "seed %d: %d states equal, %d outside the journal, %d with no hand, %d changes made again, %d hashes, "
            "%d wrenches, held in %d"
            % (seed, same, outside, waiting, summary["changes_made_again"], comparisons, wrenches, held)
        )
        self.assertGreater(same, 100)
        self.assertLess(outside + waiting, 0.2 * same)
        self.assertGreater(summary["changes_made_again"], 3)
        self.assertEqual(summary["changes_made_again"], summary["changes"])
        self.assertEqual(summary["changes_mismatched"], 0)
        self.assertGreater(comparisons, 3)
        self.assertGreater(wrenches, 100)
        return held

    def test_live_is_its_replay(self):
        self.assertGreater(sum(self.check(seed) for seed in range(SEEDS)), 20)


if __name__ == "__main__":
    rospy.init_node("live_replay_test", disable_rostime=True)
    rostest.rosrun("spring_workbench", "live_replay_test", LiveReplay, sys.argv)
