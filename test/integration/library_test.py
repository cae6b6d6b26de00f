#!/usr/bin/python3
"""The library as used by other projects: installed into a folder; each example is then built against it in another
folder, with find_package alone, and run.
Usage: library_test.py CMAKE BUILD_FOLDER CXX MODES, MODES being the contact modes that the build has engines for"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, CXX, *MODES = sys.argv[1:]
ROOT = pathlib.Path(__file__).resolve().parents[2]
MOST_HEADERS = 30
DEADLINE = 300.0  # [s] for each thing waited for; far more than it takes
ENGINES = {"libfcl": {"stop", "dynamic"}, "libBulletDynamics": {"dynamic"}}  # and the contact modes that need them


def run(*command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=DEADLINE, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done


def numbers(text):
    """The lines of numbers of a table."""
    rows = [line.split() for line in text.splitlines()]
    return [[float(cell) for cell in row] for row in rows if row and re.fullmatch(r"-?\d+\.\d+", row[0])]


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.prefix, cls.folder = pathlib.Path(folder.name, "prefix"), pathlib.Path(folder.name, "elsewhere")
        run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)
        shutil.copytree(ROOT / "examples", cls.folder)
        cls.box = cls.folder / "01_lift_a_box/box.urdf"

    def program(self, example):
        """Configures and builds a copy of the example; returns the program."""
        source, build = self.folder / example, self.folder / "build" / example
        found = [f"-DCMAKE_PREFIX_PATH={self.prefix}", f"-DCMAKE_CXX_COMPILER={CXX}"]
        run(CMAKE, "-S", source, "-B", build, *found, "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror")
        run(CMAKE, "--build", build)
        return build / example.split("_", 1)[1]

    def mapped(self, *command):
        """Returns the libraries that the dynamic linker maps in a run."""
        return run(*command, env={**os.environ, "LD_DEBUG": "files"}).stderr

    def test_headers_are_few_and_need_no_other(self):
        include = self.prefix / "include"
        generated = {p.name for p in (include / "spring_workbench").glob("*.h")} - {"spring_workbench.h"}
        headers = [p for p in include.rglob("*.h") if p.name not in generated]
        self.assertIn(include / "spring_workbench/spring_workbench.h", headers)
        self.assertLessEqual(len(headers), MOST_HEADERS)
        for header in headers:
            for included in re.findall(r'#include ["<](spring_workbench/[^">]+)', header.read_text()):
                self.assertIn(include / included, headers, f"{header} includes it")

    def test_01_the_box_comes_along_and_its_weight_is_read(self):
        program = self.program("01_lift_a_box")
        if "stop" not in MODES:
            refused = subprocess.run([program, self.box], capture_output=True, text=True, timeout=DEADLINE)
            self.assertEqual(refused.returncode, 2)
            self.assertRegex(refused.stderr, "contact: mode '.*' is not available: it needs FCL")
            return
        shutil.move(str(program), str(self.folder / "moved"))  # a program finds the engines wherever it lies
        for mode in MODES:
            self.box.with_suffix(".yaml").write_text(f"contact: {mode}\n")
            rows = numbers(run(self.folder / "moved", self.box).stdout)
            self.assertEqual(len(rows), 16)
            self.assertAlmostEqual(rows[-1][1] - rows[0][1], 0.1, places=4)  # the hand
            self.assertAlmostEqual(rows[-1][4], 0.5, places=3)  # [kg]
            sag = 0.5 * 9.81 / 2000.0  # weight over stiffness
            self.assertAlmostEqual(rows[-1][2], rows[0][2] + 0.1 - sag, delta=2e-4)
            mapped = self.mapped(self.folder / "moved", self.box)
            self.assertIn("libspring_workbench_core", mapped)
            for engine, modes in ENGINES.items():
                self.assertEqual(engine in mapped, mode in modes, f"{engine}, contact: {mode}")

    @unittest.skipUnless("stop" in MODES, "contact mode stop is left out")
    def test_the_program_of_the_readme_lifts_the_box(self):
        blocks = dict(re.findall(r"^`lift/(.*?)`:\n\n```\w+\n(.*?)^```", (ROOT / "README.md").read_text(), re.M | re.S))
        source = self.folder / "00_lift"
        source.mkdir()
        for name, text in blocks.items():
            (source / name).write_text(text)
        self.assertEqual(run(self.program("00_lift"), cwd=ROOT).stdout, "0.500 vkg\n")

    def test_02_an_own_integrator_has_its_order(self):
        program = self.program("02_own_integrator")
        rows = numbers(run(program, self.box).stdout)
        self.assertEqual(len(rows), 4)
        for row in rows[1:]:
            self.assertAlmostEqual(row[2], 2.0, delta=0.05)
        mapped = self.mapped(program, self.box)
        self.assertIn("libspring_workbench_core", mapped)
        for engine in ENGINES:  # contact: none
            self.assertNotIn(engine, mapped)

    @unittest.skipUnless("stop" in MODES, "contact mode stop is left out")
    def test_03_a_motion_is_replayed_to_the_bit(self):
        program = self.program("03_replay_a_motion")
        motion = self.folder / "03_replay_a_motion/lift_and_turn.yaml"
        self.box.with_suffix(".yaml").write_text("contact: stop\n")
        first, second = (run(program, self.box, motion).stdout for _ in range(2))
        self.assertEqual(first, second)
        rows = [line.split(",") for line in first.splitlines()[1:-1]]
        self.assertEqual(len(rows), 46)
        self.assertGreater(max(float(row[4]) for row in rows), 0.14)
        for value, place in zip(rows[-1][2:5], [0.2, 0.0, 0.03]):  # put down, on the bench
            self.assertAlmostEqual(float(value), place, delta=1e-3)
        self.assertEqual([row[5] for row in (rows[0], rows[20], rows[-1])], ["0", "1", "0"])
        self.assertRegex(first.splitlines()[-1], "^# state [0-9a-f]{16}$")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
