#!/usr/bin/python3
"""A live run is its replay: three hands, what three machines measure, services and live settings changed at random,
recorded with rosbag; every committed state equals what `replay` makes of the bag, bit by bit, and so does the state's
hash at every comparison and at the end. `replay` makes each change again at its time, and it leads to the recorded
state. Only states from before the recording of the journal was complete are not compared, and it is before the session
begins. Every other recorder is connected to the changes before it is to the inputs, which another listener makes the
node publish already. Several sessions run at the same time, each with a master of its own, and beside them a busy
process for each processor.

LIVE_SEEDS: how many sessions; LIVE_FIRST: the first seed; LIVE_LENGTH: of each [s]; LIVE_AT_ONCE: how many at the same
time; LIVE_TABLE: path of a table of the results, if none failed."""
import contextlib
import csv
import json
import math
import os
import random
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
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
FIRST = int(os.environ.get("LIVE_FIRST", "0"))
LENGTH = float(os.environ.get("LIVE_LENGTH", "60"))  # [s]
AT_ONCE = int(os.environ.get("LIVE_AT_ONCE", "3"))
TABLE = os.environ.get("LIVE_TABLE")
PACKAGE = rospkg.RosPack().get_path("spring_workbench")
BRICK = "package://spring_workbench/test/integration/data/brick.urdf"
SCENE = os.path.join(PACKAGE, "scenes", "single_box.urdf")
MANIPULATION = roslib.packages.find_node("spring_workbench", "manipulation")
REPLAY = roslib.packages.find_node("spring_workbench", "replay")
TOPICS = ["/manipulation/" + name for name in ("accepted", "changes", "objects")]
JOURNAL = TOPICS[:2]
RESTARTS = ("the hand's time begins", "load_scene", "reset")  # changes with which time begins anew, at the next sample
VIEWED = ["/tf", *("/manipulation/" + name for name in ("markers", "display/objects", "display/fork"))]


MANY = 3
BEGUN = ".begun"  # beside the bag: what follows is recorded


def ending(hand):
    return "" if hand == 0 else "_%d" % (hand + 1)


class Hands:
    """Three hands on the wall clock, each with its own rate: they reach for the box, lift it, shake and release it."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.joy = [rospy.Publisher("stylus%s/joy" % ending(hand), Joy, queue_size=100) for hand in range(MANY)]
        self.sensors = [
            rospy.Publisher("manipulation/external_wrench" + ending(hand), WrenchStamped, queue_size=100)
            for hand in range(MANY)
        ]
        self.rates = [self.random.choice([30.0, 60.0, 120.0]) for _ in range(MANY)]
        self.goal = [self.new_goal(hand) for hand in range(MANY)]
        self.position = list(self.goal)
        self.next = [time.time()] * MANY
        self.pressed, self.clutch = [False] * MANY, [False] * MANY

    def new_goal(self, hand):
        reach = self.random.random() < 0.6
        return [
            0.02 * (1 - hand) + self.random.gauss(0.0, 0.005 if reach else 0.05),
            self.random.gauss(0.0, 0.005 if reach else 0.05),
            0.22 if reach else self.random.uniform(0.25, 0.45),
        ]

    def step(self):
        now = time.time()
        for hand in range(MANY):
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
            transform.child_frame_id = "stylus" + ending(hand)
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
        measured.header.frame_id = self.random.choice(["world", "fork_tip" + ending(hand)])
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
                    tool=r.choice(["spring", "spring_fork", "spring_probe", "direct", "ray"]), stylus=r.randint(1, MANY)
                ),
                lambda: call["set_dofs"](
                    stretch=r.random() < 0.7, bend=r.random() < 0.7, torsion=r.random() < 0.7, stylus=r.randint(0, MANY)
                ),
                lambda: call["set_stiffness"](
                    stretch=r.uniform(100.0, 2000.0), bend=r.uniform(50.0, 500.0), stylus=r.randint(0, MANY)
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
                lambda: call["release"](stylus=r.randint(0, MANY)),
                lambda: call["calibrate"](stylus=r.randint(0, MANY)),
                lambda: call["clutch"](on=r.random() < 0.5, stylus=r.randint(0, MANY)),
                lambda: call["edit_object"](action="mass", name="box", mass=r.choice([0.0, r.uniform(0.5, 3.0)])),
                lambda: call["edit_object"](action="friction", name="box", friction=r.uniform(0.0, 1.0)),
                lambda: self.add_or_remove(),
                lambda: call["undo"](),
                call["reset"] if r.random() < 0.3 else call["release"],
                (lambda: call["load_scene"](scene=SCENE)) if r.random() < 0.3 else call["calibrate"],
            ]
        )()


def options_of(seed):
    """Eight consecutive seeds cover each combination of rate, further subscribers, and prediction once; the first three
    cover both values of each."""
    case = [7, 0, 5, 2, 6, 1, 4, 3][seed % 8]
    rate, viewed, latency = [50, 1000][case % 2], [[], VIEWED][case // 2 % 2], [0.0, 0.03][case // 4 % 2]
    return ["rate:=%d" % rate, "display_latency:=%g" % latency], viewed


def end(process):
    process.send_signal(signal.SIGINT)
    process.wait(DEADLINE)


def complete_from(indices):
    """Index of the first message of the journal from which on none is missing."""
    indices = sorted(indices)
    return max((b for a, b in zip(indices, indices[1:]) if b > a + 1), default=indices[0])


def record(seed, bag):
    """Records a session of one node, which has its usual name. Returns the time at which it begins [ns]."""
    options, viewed = options_of(seed)
    options += ["scene:=" + SCENE, "contact:=dynamic", "styluses:=%d" % MANY]
    node = subprocess.Popen([*MANIPULATION, *("_" + option for option in options)])
    services = Services(seed)
    recorder = subprocess.Popen([sys.executable, __file__, "--record", bag, *(["--late"] if seed % 2 else [])])
    changes = Listener("manipulation/changes", Change)
    listener = rospy.Subscriber("manipulation/accepted", Accepted, lambda _: None)
    viewers = [rospy.Subscriber(topic, rospy.AnyMsg, lambda _: None) for topic in viewed]
    hands = Hands(seed)
    wait_for(lambda: hands.tf.get_num_connections() > 0 and changes.last, "the journal to begin")
    wait_for(lambda: hands.step() or os.path.exists(bag + BEGUN), "the recorder")
    wait_for(lambda: all(viewer.get_num_connections() > 0 for viewer in viewers), "the viewers")
    r = random.Random(seed)
    begin, next_call = time.time(), time.time() + 1.0
    began = rospy.Time.now().to_nsec()
    while time.time() < begin + LENGTH:
        hands.step()
        if time.time() > next_call:
            services.one()
            next_call = time.time() + r.uniform(0.1, 0.8)
        time.sleep(0.002)
    listener.unregister()
    changes.subscriber.unregister()
    end(recorder)
    end(node)
    return began


class Recorder:
    """Writes a bag. The queue of `rosbag record` holds 100 messages, which a busy machine overruns; the ones here have
    no end. Each topic arrives in order: the run is whole up to what the slowest one has brought."""

    def __init__(self, bag):
        self.bag, self.lock = bag, threading.Lock()
        self.indices = {topic: [] for topic in JOURNAL}
        self.states = []  # indices of the changes that have one
        self.kept = None  # messages since the end was asked for: topic, position in the run, raw message
        self.last = None  # the comparison that ends the bag: its index, its stamp
        self.newest_objects = 0  # [ns]
        self.subscribers = []

    def subscribe(self, *topics):
        self.subscribers += [rospy.Subscriber(topic, rospy.AnyMsg, self.write, topic) for topic in topics]

    def write(self, message, topic):
        kind = message._connection_header
        (frame_length,) = struct.unpack_from("<I", message._buff, 12)
        raw = (kind["type"], message._buff, kind["md5sum"], None)
        with self.lock:
            if topic in JOURNAL:
                (position,) = struct.unpack_from("<Q", message._buff, 16 + frame_length)
                self.indices[topic].append(position)
                if topic == TOPICS[1]:
                    self.on_change(Change().deserialize(message._buff), position)
            else:
                seconds, nanoseconds = struct.unpack_from("<II", message._buff, 4)
                position = self.newest_objects = seconds * 10**9 + nanoseconds
            if self.kept is None:
                self.bag.write(topic, raw, raw=True)
            else:
                self.kept.append((topic, position, raw))

    def on_change(self, change, index):
        if change.state:
            self.states.append(index)
        elif self.kept is not None and self.last is None and index > self.newest_when_asked:
            self.last = index, change.header.stamp.to_nsec()

    def newest(self):
        return [indices[-1] for indices in self.indices.values()]

    def is_complete(self):
        """Whether the journal has come since a state, without a gap."""
        with self.lock:
            if not all(self.indices.values()):
                return False
            complete = complete_from(sum(self.indices.values(), []))
            return any(index >= complete for index in self.states)

    def has_come(self):
        """Whether all topics have come up to the comparison that ends the bag."""
        return self.last and min(self.newest()) >= self.last[0] and self.newest_objects > self.last[1]

    def end(self):
        """Ends the bag with a comparison: it has the hash of the state at the end."""
        with self.lock:
            self.newest_when_asked, self.kept = max(self.newest()), []
        wait_for(self.has_come, "the rest of the run")
        for subscriber in self.subscribers:
            subscriber.unregister()
        with self.lock:
            for topic, position, raw in self.kept:
                if position <= self.last[0 if topic in JOURNAL else 1]:
                    self.bag.write(topic, raw, raw=True)


def record_topics(late):
    """Writes a bag until it is interrupted."""
    rospy.init_node("record", disable_rostime=True, disable_signals=True)
    interrupted = threading.Event()
    signal.signal(signal.SIGINT, lambda *_: interrupted.set())
    with rosbag.Bag(sys.argv[2], "w") as bag:
        recorder = Recorder(bag)
        recorder.subscribe(TOPICS[1], TOPICS[2])
        if late:
            changes = recorder.indices[TOPICS[1]]
            wait_for(lambda: changes and changes[-1] - changes[0] >= len(changes), "an input that is missed")
        recorder.subscribe(TOPICS[0])
        wait_for(recorder.is_complete, "the whole journal")
        with open(sys.argv[2] + BEGUN, "w"):
            pass
        interrupted.wait()
        recorder.end()
    rospy.signal_shutdown("interrupted")


def replay(bag, out):
    """Returns (time [ns], object) -> poses and twists (several if there was a change), and the summary."""
    command = [*REPLAY, "--scene", SCENE, "--bag", bag, "--out", out, "--set", "contact=dynamic"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    rows = {}
    with open(out) as file:
        for row in csv.DictReader(file):
            numbers = tuple(float(row[key]) for key in "x y z qx qy qz qw vx vy vz wx wy wz".split())
            rows.setdefault((round(float(row["t"]) * 1e9), row["object"]), []).append(numbers)
    return rows, json.loads(done.stdout.splitlines()[-1])


def numbers_of(state):
    p, q, v, w = state.pose.position, state.pose.orientation, state.twist.linear, state.twist.angular
    sign = -1.0 if q.w < 0.0 else 1.0
    return (p.x, p.y, p.z, sign * q.x, sign * q.y, sign * q.z, sign * q.w, v.x, v.y, v.z, w.x, w.y, w.z)


def times_without_a_hand(journal):
    """Intervals of the wall clock [ns] in which no sample had come since time restarted: each from the stamp of the
    newest input before the restart to the arrival of the next pose."""
    intervals, newest, begin = [], 0, None
    for topic, message, arrival in sorted(journal, key=lambda m: m.message.index):
        if topic == JOURNAL[1]:
            if message.what in RESTARTS and begin is None:
                begin = newest
            continue
        newest = max(newest, message.header.stamp.to_nsec())
        if message.kind == Accepted.POSE and begin is not None:
            intervals.append((begin, arrival.to_nsec()))
            begin = None
    return intervals + ([] if begin is None else [(begin, math.inf)])


def compare(messages, rows, without_hand, began):
    """Numbers of states: equal, before the journal was complete, and without a hand. Raises AssertionError if one
    differs. `without_hand`: intervals of the clock [ns]; `began`: time from which on each has to be compared [ns]."""
    # Several where time was left out, and by rounding of one nanosecond.
    zeros = {m.header.stamp.to_nsec() - round(m.time * 1e9) for m in messages[TOPICS[0]]}
    for change in messages[TOPICS[1]]:
        if not change.state and math.isfinite(change.committed):
            zeros.add(change.header.stamp.to_nsec() - round(change.committed * 1e9))
    # Another listener's journal may have been under way: this one begins with the first state from which on no message
    # is missing.
    complete = complete_from(m.index for topic in JOURNAL for m in messages[topic])
    begin = next(m.header.stamp.to_nsec() for m in messages[TOPICS[1]] if m.state and m.index >= complete)
    assert begin < began, "the journal begins %g s after the session" % (1e-9 * (begin - began))
    replayed = {}  # where no hand is known, the stamp is the clock's: the state is that after a change
    for (_, name), states in rows.items():
        replayed.setdefault(name, set()).update(states)
    same = before = waiting = 0
    for message in messages[TOPICS[2]]:
        stamp = message.header.stamp.to_nsec()
        for state in message.objects:
            if stamp <= begin:
                before += 1
                continue
            found = [n for zero in zeros for n in rows.get((stamp - zero, state.name), [])]
            numbers = numbers_of(state)
            if found:
                assert numbers in found, "%s differs at %d" % (state.name, stamp)
                same += 1
                continue
            assert any(a < stamp < b for a, b in without_hand), "%s at %d is not replayed" % (state.name, stamp)
            assert numbers in replayed[state.name], "%s differs at %d" % (state.name, stamp)
            assert not any(numbers[7:]), "%s moves at %d with no hand" % (state.name, stamp)
            waiting += 1
    return same, before, waiting


def last_hash(messages):
    """The hash of the node's state at the end of the bag."""
    last = max((m for topic in JOURNAL for m in messages[topic]), key=lambda m: m.index)
    assert not last.state, "the bag does not end with a comparison"
    return last.hash_before


def session():
    """Runs in a separate process, because it has its own master; prints the result as JSON."""
    seed = int(sys.argv[2])
    rospy.init_node("session", disable_rostime=True)
    folder = tempfile.mkdtemp(prefix="live_replay_%d_" % seed)  # stays where something differs
    bag = os.path.join(folder, "run.bag")
    began = record(seed, bag)
    rows, summary = replay(bag, os.path.join(folder, "run.csv"))
    with rosbag.Bag(bag) as recorded:
        messages = {topic: [m.message for m in recorded.read_messages(topic)] for topic in TOPICS}
        without_hand = times_without_a_hand(recorded.read_messages(JOURNAL))
    same, before, waiting = compare(messages, rows, without_hand, began)
    shutil.rmtree(folder)
    accepted, changes, objects = (messages[topic] for topic in TOPICS)
    result = {
        "states equal": same,
        "before the journal": before,
        "with no hand": waiting,
        "changes": summary["changes"],
        "made again": summary["changes_replayed"],
        "mismatched": summary["changes_mismatched"],
        "hashes": sum(not m.state for m in changes),
        "wrenches": sum(m.kind == Accepted.EXTERNAL_WRENCH for m in accepted),
        "held in": sum(any(o.held for o in m.objects) for m in objects),
        "hash": summary["state_hash"],
        "hash of the node": last_hash(messages),
    }
    print(json.dumps(result), flush=True)


class Session:
    """A running session: a master, and this file as a process."""

    def __init__(self, seed):
        with socket.socket() as s:
            s.bind(("", 0))
            port = s.getsockname()[1]
        environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % port)
        self.seed = seed
        self.master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], env=environment)
        wait_for(lambda: not socket.socket().connect_ex(("localhost", port)), "the master")
        self.process = subprocess.Popen(
            [sys.executable, __file__, "--session", str(seed)],
            env=environment,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def end(self):
        """Ends the session; returns its result, or None if it failed."""
        said = self.process.communicate()[0].splitlines()
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)  # nodes that a failure left behind
        self.master.kill()
        self.master.wait()
        result = json.loads(said[-1]) if self.process.returncode == 0 else None
        print("seed %d, %s: %s" % (self.seed, " ".join(options_of(self.seed)[0]), result or "FAILED"), flush=True)
        return result


def write_table(results):
    with open(TABLE, "w") as file:
        table = csv.DictWriter(file, ["seed", "options", *next(iter(results.values()))], lineterminator="\n")
        table.writeheader()
        for seed, result in sorted(results.items()):
            table.writerow({"seed": seed, "options": " ".join(options_of(seed)[0]), **result})


class LiveReplay(unittest.TestCase):
    def run_all(self):
        waiting, running, results = list(range(FIRST, FIRST + SEEDS)), [], {}
        while waiting or running:
            while waiting and len(running) < AT_ONCE:
                running.append(Session(waiting.pop(0)))
            for done in [one for one in running if one.process.poll() is not None or not waiting]:
                running.remove(done)
                results[done.seed] = done.end()
            time.sleep(0.1)
        return results

    def test_live_is_its_replay(self):
        busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count())]
        try:
            results = self.run_all()
        finally:
            for process in busy:
                process.kill()
                process.wait()
        self.assertEqual([seed for seed, result in results.items() if result is None], [])
        for seed, result in results.items():
            with self.subTest(seed=seed):
                self.assertGreater(result["states equal"], 100)
                self.assertEqual(result["hash"], result["hash of the node"])
                self.assertGreater(result["made again"], 3)
                self.assertEqual(result["made again"], result["changes"])
                self.assertEqual(result["mismatched"], 0)
                self.assertGreater(result["hashes"], 3)
                self.assertGreater(result["wrenches"], 100)
        self.assertGreater(sum(result["held in"] for result in results.values()), 20)
        if TABLE:
            write_table(results)


if __name__ == "__main__":
    if "--session" in sys.argv:
        session()
    elif "--record" in sys.argv:
        record_topics("--late" in sys.argv)
    else:
        rostest.rosrun("spring_workbench", "live_replay_test", LiveReplay, sys.argv)
