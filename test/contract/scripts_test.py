#!/usr/bin/env python3
"""shellcheck over every shell script of the repository. Status 77: shellcheck is missing."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("scripts", ".ci", "launch", "test", "benchmark", "examples")
SHELLS = ("bash", "sh")


def is_shell_script(path):
    if not path.is_file():
        return False
    with path.open("rb") as file:
        first = file.readline(100)
    return first.startswith(b"#!") and first.split()[-1].split(b"/")[-1].decode() in SHELLS


def shell_scripts(root):
    return sorted(path for folder in FOLDERS for path in (root / folder).rglob("*") if is_shell_script(path))


def complaints(paths):
    run = subprocess.run(["shellcheck", "--external-sources", *map(str, paths)], capture_output=True, text=True)
    return run.stdout + run.stderr


class Scripts(unittest.TestCase):
    def test_all_are_clean(self):
        paths = shell_scripts(ROOT)
        self.assertIn(ROOT / "scripts/build", paths)
        self.assertIn(ROOT / ".ci/run", paths)
        self.assertEqual(complaints(paths), "")

    def test_a_fault_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder) / "scripts/faulty"
            script.parent.mkdir()
            script.write_text("#!/usr/bin/env bash\nrm -rf $1/bin\n")
            self.assertEqual(shell_scripts(pathlib.Path(folder)), [script])
            self.assertIn("SC2086", complaints([script]))


if __name__ == "__main__":
    if not shutil.which("shellcheck"):
        print("no shellcheck: skipped")
        sys.exit(77)
    unittest.main()
