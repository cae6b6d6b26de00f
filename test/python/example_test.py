"""examples/04_python as a user runs it, and the program of the README."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DRAW = ROOT / "examples/04_python/draw.py"


class Example(unittest.TestCase):
    def test_it_draws_and_the_methods_have_their_order(self):
        with tempfile.TemporaryDirectory() as folder:
            said = subprocess.run(
                [sys.executable, DRAW, "--out", folder], check=True, capture_output=True, text=True, timeout=300
            ).stdout
            for name in ["swing.png", "work_precision.png"]:
                picture = pathlib.Path(folder, name).read_bytes()
                self.assertEqual(picture[:4], b"\x89PNG")
                self.assertGreater(len(picture), 10000)
        errors = {}
        for line in said.splitlines()[1:]:
            integrator, _, error = line.split()
            errors.setdefault(integrator, []).append(float(error))
        self.assertGreater(len(errors), 3)
        self.assertLess(max(errors["exponential"]), 1e-6)
        self.assertAlmostEqual(errors["implicit_euler"][-2] / errors["implicit_euler"][-1], 2.0, delta=0.2)  # order 1

    def test_the_program_of_the_readme_lifts_the_box(self):
        lines = re.search(r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(), re.M | re.S).group(1)
        lines += "print(simulation.poses[0, 2, 3])\n"
        command = [sys.executable, "-c", lines]
        said = subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout
        weight, height = said.splitlines()
        self.assertEqual(weight, "0.500 vkg")
        self.assertAlmostEqual(float(height), 0.03 + 0.1 - 0.5 * 9.81 / 2000.0, delta=2e-4)  # weight over stiffness

    def test_the_lift_of_the_library_document_prints_what_it_says(self):
        lines = re.search(r"^```python\n(.*?)^```", (ROOT / "doc/library.md").read_text(), re.M | re.S).group(1)
        command = [sys.executable, "-c", lines]
        said = subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout
        self.assertEqual("# " + said.strip(), lines.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
