#!/usr/bin/python3
"""A catkin workspace with a package of another name that uses messages and library of the installed spring_workbench:
catkin_make_isolated --install, then its programs run from its install space.
Usage: catkin_workspace_test.py CMAKE BUILD_FOLDER PYTHON"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, PYTHON = sys.argv[1:]
ROOT = pathlib.Path(__file__).resolve().parents[2]
DEADLINE = 300.0  # [s] for each thing waited for; far more than it takes


def run(*command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=DEADLINE, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


class CatkinWorkspace(unittest.TestCase):
    def test_another_package_uses_messages_and_library(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        prefix, workspace = pathlib.Path(folder.name, "prefix"), pathlib.Path(folder.name, "workspace")
        run(CMAKE, "--install", BUILD, "--prefix", prefix)
        shutil.copytree(ROOT / "test/data/stranger", workspace / "src/stranger")
        make = f"catkin_make_isolated --install -DPYTHON_EXECUTABLE={PYTHON}"
        run("bash", "-c", f"source {prefix}/setup.bash && {make}", cwd=workspace)
        box = ROOT / "examples/01_lift_a_box/box.urdf"
        for program in ["by_variables", "by_target"]:
            command = f"source install_isolated/setup.bash && rosrun stranger {program} {box}"
            said = run("bash", "-c", command, cwd=workspace)
            fields = dict(line.split(": ", 1) for line in said.splitlines() if ": " in line)
            self.assertEqual(fields["held_object"], "box")
            self.assertAlmostEqual(float(fields["stretch"]), 0.5 * 9.81 / 2000.0, delta=1e-6)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
