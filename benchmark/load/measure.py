#!/usr/bin/python3
"""Runs the node `load` (main.cpp) against manipulation and tracker_driver, one case after the other, on a ROS master
of its own, and writes the tables scenes.csv and load.csv, which doc/load.md quotes. scripts/load calls it."""
import argparse
import csv
import itertools
import math
import os
import pathlib
import platform
import re
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "build/devel/lib/spring_workbench"
DEADLINE = 60.0  # [s]
SCENES = ["single_box", "mini_world"]
CONTACTS = ["none", "stop", "dynamic"]
RATES = [(50, 100), (120, 100), (1000, 1000)]  # of the tracker for each hand, and of manipulation [Hz]
GRID_LINK = """<link name="box%d"><inertial><mass value="0.1"/>
                      <inertia ixx="3e-5" iyy="3e-5" izz="3e-5" ixy="0" ixz="0" iyz="0"/>
</inertial><visual><geometry><box size="0.04 0.04 0.04"/></geometry></visual>
<collision><geometry><box size="0.04 0.04 0.04"/></geometry></collision></link>
<joint name="j%d" type="floating"><parent link="workbench"/><child link="box%d"/><origin xyz="%g %g 0.02"/></joint>
"""


def grid(folder, count):
    """A scene with a square grid of boxes on the bench, and two boxes next to it for the hands to push."""
    side = math.ceil(math.sqrt(count - 2))
    places = [(0.0, -0.1), (0.0, -0.2)] + [(0.1 * (i % side), 0.1 * (i // side)) for i in range(count - 2)]
    links = "".join(GRID_LINK % (i, i, i, x, y) for i, (x, y) in enumerate(places))
    path = folder / ("grid%d.urdf" % count)
    path.write_text("<robot name='grid'><link name='workbench'/>%s</robot>" % links)
    return path


class Master:
    """A ROS master on a free port; parameters are set by rosparam."""

    def __enter__(self):
        with socket.socket() as s:
            s.bind(("", 0))
            port = s.getsockname()[1]
        self.environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % port)
        self.process = subprocess.Popen(
            ["roscore", "-p", str(port)], env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        end = time.monotonic() + DEADLINE
        while (
            subprocess.run(["rosparam", "list"], env=self.environment, capture_output=True, check=False).returncode != 0
        ):
            if time.monotonic() > end:
                raise RuntimeError("no ROS master")
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def start(self, program, **parameters):
        text = "{%s}" % ", ".join("%s: %s" % (key, value) for key, value in parameters.items())
        subprocess.run(["rosparam", "set", "/" + program, text], env=self.environment, check=True)
        return subprocess.Popen(
            [str(PROGRAMS / program)],
            env=self.environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )

    def forget(self):
        for node in ["manipulation", "tracker_driver", "load"]:
            subprocess.run(["rosparam", "delete", "/" + node], env=self.environment, capture_output=True, check=False)


class CannotKeepUpError(RuntimeError):
    """Almost none of the hand's samples appeared in the output."""


def measure(master, folder, scene, contact, hands, rate, physics_rate, length):
    """The fields that `load` prints, in its order."""
    out, port = folder / "row.csv", folder / "port"
    node = master.start("manipulation", scene=scene, contact=contact, rate=physics_rate)
    load = master.start("load", scene=scene, hands=hands, rate=rate, length=length, port=port, out=out, pid=node.pid)
    end = time.monotonic() + DEADLINE
    while not port.is_symlink():
        if time.monotonic() > end or load.poll() is not None:
            raise RuntimeError("no device: " + load.communicate()[1])
        time.sleep(0.01)
    both = [1, 2][:hands]
    driver = master.start(
        "tracker_driver",
        source="fastrak",
        port=port,
        baud=115200,
        stations=both,
        stylus=both,
        hemisphere="0 0 1",
        offset="0 0 0 0 0 0 1",
    )
    try:
        output = load.communicate(timeout=length + DEADLINE)[1]
        if load.returncode != 0:
            raise CannotKeepUpError(output) if "records were seen again" in output else RuntimeError(output)
        return out.read_text().strip().split(",")
    finally:
        for process in [load, driver, node]:
            process.terminate()
            process.communicate()
        master.forget()


def write(path, header, head, rows):
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(header)
        csv.writer(file, lineterminator="\n").writerows([head, *rows])


def scenes_table(master, folder, length):
    rows = []
    for name in SCENES:
        for contact in CONTACTS:
            f = measure(master, folder, ROOT / "scenes" / (name + ".urdf"), contact, 1, 120, 100, min(length, 5.0))
            rows.append([name, contact, f[10], f[11], "%.0f" % float(f[3]), "%.0f" % float(f[0]), "%.1f" % float(f[1])])
            print("| " + " | ".join(rows[-1]) + " |", flush=True)
    return ["scene", "contact", "active", "skipped", "cycle 50 % [µs]", "start [ms]", "resident [MB]"], rows


def load_table(master, folder, length):
    rows = []
    for name, scene, cases in [
        ("mini_world", ROOT / "scenes/mini_world.urdf", itertools.product([1, 2], RATES)),
        ("1000 objects", grid(folder, 1000), itertools.product([1, 2], RATES)),
        ("10,000 objects", grid(folder, 10000), itertools.product([1, 2], RATES[:2])),
    ]:
        for hands, (rate, physics_rate) in cases:
            try:
                f = measure(master, folder, scene, "stop", hands, rate, physics_rate, length)
                figures = [
                    *["%.0f" % float(x) for x in f[3:6]],
                    "%.0f" % float(f[12]),
                    "%s of %s" % (f[6], f[2]),
                    *["%.1f" % float(x) for x in f[7:10]],
                    "%.0f" % float(f[13]),
                    "%.1f" % float(f[1]),
                ]
            except CannotKeepUpError:
                figures = ["–"] * 10
            rows.append([name, str(hands), str(rate), str(physics_rate), *figures])
            print("| " + " | ".join(rows[-1]) + " |", flush=True)
    return [
        "scene",
        "hands",
        "tracker [Hz]",
        "manipulation [Hz]",
        "cycle 50 % [µs]",
        "cycle 99 % [µs]",
        "cycle 99.9 % [µs]",
        "publishing 99 % [µs]",
        "deadlines missed",
        "latency 50 % [ms]",
        "latency 99 % [ms]",
        "latency longest [ms]",
        "processor [%]",
        "resident [MB]",
    ], rows


def machine():
    with open("/proc/cpuinfo") as file:
        model = re.search(r"model name\s*: (.*)", file.read())
    return "%s, %d processors, Linux %s" % (
        model.group(1) if model else platform.machine(),
        os.cpu_count(),
        platform.release(),
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--length", type=float, default=15.0)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "benchmark/results/load")
    parser.add_argument("--commit", default="not given")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    header = "# machine: %s\n# date: %s\n# command: scripts/load --length %g\n# commit: %s\n" % (
        machine(),
        time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime()),
        arguments.length,
        arguments.commit,
    )
    with tempfile.TemporaryDirectory() as folder, Master() as master:
        for name, make in [("scenes", scenes_table), ("load", load_table)]:
            head, rows = make(master, pathlib.Path(folder), arguments.length)
            write(arguments.out / (name + ".csv"), header, head, rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
