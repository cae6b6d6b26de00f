#!/usr/bin/python3
"""The files that `cmake --install` puts into a folder work there: the demo, with an object in the hand, and replay.
Usage: installed_test.py CMAKE BUILD_FOLDER"""
import os
import socket
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD = sys.argv[1:3]
DEADLINE = 120.0  # [s] for each thing waited for; far more than it takes


def free_port():
    with socket.socket() as s:
        s.bind(("", 0))
        return str(s.getsockname()[1])


class Installed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.prefix, self.port = folder.name + "/prefix", free_port()
        subprocess.run(
            [CMAKE, "--install", BUILD, "--prefix", self.prefix],
            check=True,
            stdout=subprocess.DEVNULL,
            timeout=DEADLINE,
        )
        sourced = subprocess.run(
            [self.prefix + "/env.sh", "env", "-0"], capture_output=True, text=True, check=True, timeout=DEADLINE
        )
        self.environment = dict(line.split("=", 1) for line in sourced.stdout.split("\0") if line)
        self.environment.update(ROS_HOME=folder.name, ROS_MASTER_URI="http://localhost:" + self.port)

    def test_its_setup_files_name_nothing_of_the_build(self):
        for name in ["CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "LD_LIBRARY_PATH", "PYTHONPATH"]:
            self.assertIn(self.prefix, self.environment[name])
            self.assertNotIn(os.path.realpath(BUILD), self.environment[name])

    def test_it_goes_nowhere_else(self):
        with open(BUILD + "/install_manifest.txt") as manifest:
            for file in manifest.read().split():
                self.assertEqual(os.path.commonpath([self.prefix, file]), self.prefix)

    def test_replay_reads_from_the_installed_package(self):
        subprocess.run(
            [
                self.prefix + "/lib/spring_workbench/replay",
                "--scene",
                "package://spring_workbench/scenes/mini_world.urdf",
                "--motion",
                self.prefix + "/share/spring_workbench/config/mini_world_demo.yaml",
                "--out",
                "run.csv",
            ],
            check=True,
            cwd=self.prefix,
            env=self.environment,
            timeout=DEADLINE,
            stdout=subprocess.DEVNULL,
        )
        with open(self.prefix + "/run.csv") as file:
            self.assertGreater(sum(1 for _ in file), 100)

    def test_the_demo_takes_an_object_into_the_hand(self):
        launch = subprocess.Popen(
            ["roslaunch", "-p", self.port, "spring_workbench", "demo.launch", "rviz:=false", "pause:=0"],
            env=self.environment,
        )
        try:
            subprocess.run(
                ["bash", "-c", "until rostopic list 2>&1 | grep -q /manipulation/fork$; do sleep 0.2; done"],
                check=True,
                env=self.environment,
                timeout=DEADLINE,
            )
            held = subprocess.run(
                ["rostopic", "echo", "-n", "1", "--filter", "m.held_object != ''", "/manipulation/fork"],
                env=self.environment,
                timeout=DEADLINE,
                capture_output=True,
                text=True,
            )
            self.assertIn("held_object", held.stdout)
        finally:
            launch.terminate()
            launch.wait(DEADLINE)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
