"""The stubs match the compiled module, by mypy's stubtest, without the modules of the messages."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import spring_workbench

# What pybind11's classes have and no stub says: their metaclass, and for those that are not made in Python an __init__.
CLASSES = "|".join(name for name in spring_workbench.__all__ if name[0].isupper())
OF_PYBIND11 = rf"spring_workbench(\._core)?\.({CLASSES})(\.__init__)?"
BUILT = pathlib.Path(spring_workbench.__file__).parent


class Stubs(unittest.TestCase):
    def check(self, change):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder, "spring_workbench")
            package.mkdir()
            for file in BUILT.iterdir():
                if file.is_file():
                    (package / file.name).symlink_to(file)
            stubs = package / "_core.pyi"
            text = stubs.read_text()
            stubs.unlink()
            stubs.write_text(change(text))
            (package.parent / "allowed").write_text(OF_PYBIND11)
            return subprocess.run(
                [sys.executable, "-m", "mypy.stubtest", "spring_workbench", "--allowlist", "allowed"],
                cwd=folder,
                env={**os.environ, "PYTHONPATH": folder},
                capture_output=True,
                text=True,
                timeout=300,
            )

    def test_they_agree(self):
        done = self.check(lambda text: text)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_fault_is_found(self):
        done = self.check(lambda text: text.replace("def release(self", "def let_go(self"))
        self.assertIn("let_go", done.stdout)
        self.assertNotEqual(done.returncode, 0)


if __name__ == "__main__":
    unittest.main()
