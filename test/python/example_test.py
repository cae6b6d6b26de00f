"""examples/04_python as a user runs it."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

DRAW = pathlib.Path(__file__).resolve().parents[2] / "examples/04_python/draw.py"


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


if __name__ == "__main__":
    unittest.main()
