#!/usr/bin/env python3
"""shellcheck over every shell script of the repository, and the help of all of scripts/. Status 77: shellcheck is
missing."""
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("scripts", ".ci", "launch", "test", "benchmark", "examples")
SHELLS = ("bash", "sh")
SOURCED = {"usage"}  # not a command
FORWARDING = {"build", "demo", "report", "test"}  # which give other options to a program
DEADLINE = 60.0  # [s]


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


class Help(unittest.TestCase):
    def commands(self):
        found = [p for p in sorted((ROOT / "scripts").iterdir()) if p.is_file() and not p.suffix]
        if not importlib.util.find_spec("spring_workbench"):  # its messages, from the setup file
            found.remove(ROOT / "scripts/study")
        return [path for path in found if path.name not in SOURCED]

    def test_each_says_what_it_is_for_and_does_nothing(self):
        self.assertGreater(len(self.commands()), 25)
        for path in self.commands():
            with self.subTest(script=path.name), tempfile.TemporaryDirectory() as folder:
                how = {"capture_output": True, "text": True, "timeout": DEADLINE, "cwd": folder}
                done = subprocess.run([path, "--help"], **how)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                start = re.search(r'(?m)^(?:# |""")(.*)$', path.read_text()).group(1)
                self.assertIn(" ".join(start.split()[:4]), " ".join(done.stdout.split()))
                if path.name in FORWARDING:
                    continue
                refused = subprocess.run([path, "--no-such-option"], **how)
                self.assertEqual((refused.returncode, refused.stdout), (2, ""))
                self.assertNotEqual(refused.stderr, "")


if __name__ == "__main__":
    if not shutil.which("shellcheck"):
        print("no shellcheck: skipped")
        sys.exit(77)
    unittest.main()
