#!/usr/bin/python3
"""The C++ code is formatted by clang-format, and no line of code is longer than 120 columns.

Status 77, which ctest shows as skipped, if clang-format is missing; the columns are counted before."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unicodedata
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = 120
FOLDERS = [".ci", "benchmark", "cmake", "examples", "include", "python", "scripts", "src", "test"]
CPP = {".cpp", ".h"}
CODE = CPP | {".cmake", ".py", ".sh", ".txt", ""}  # without a suffix: the scripts


def files_in(root):
    found = [root / "CMakeLists.txt"]
    for folder in FOLDERS:
        found += sorted(p for p in (root / folder).rglob("*") if p.suffix in CODE and p.is_file())
    return [p for p in found if not {"corpus", "__pycache__"} & set(p.parts)]


def columns_of(line):
    """Number of columns: characters, not bytes; combining accents do not count."""
    return sum(1 for letter in line if not unicodedata.combining(letter))


def long_lines(files, root):
    return [
        f"{path.relative_to(root)}:{number}: {columns_of(line)} columns"
        for path in files
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if columns_of(line) > COLUMNS
    ]


def unformatted(formatter, files):
    cpp = [str(path) for path in files if path.suffix in CPP]
    run = subprocess.run([formatter, "--dry-run", "--ferror-limit=1", *cpp], capture_output=True, text=True, check=True)
    return [line for line in run.stderr.splitlines() if "clang-format-violations" in line]


class Format(unittest.TestCase):
    def test_no_line_is_too_long(self):
        files = files_in(ROOT)
        self.assertGreater(len(files), 300)
        self.assertEqual(long_lines(files, ROOT), [])

    def test_the_cpp_is_formatted(self):
        self.assertEqual(unformatted(FORMATTER, files_in(ROOT)), [], "clang-format -i mends these")

    def test_faults_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.cpp"
            (path.parent / ".clang-format").write_text((ROOT / ".clang-format").read_text())
            path.write_text("int  a;\n// " + "ä" * COLUMNS + "\n")
            self.assertEqual(len(long_lines([path], path.parent)), 1)
            self.assertNotEqual(unformatted(FORMATTER, [path]), [])


if __name__ == "__main__":
    FORMATTER = shutil.which("clang-format-14") or shutil.which("clang-format")
    if not FORMATTER:
        faults = long_lines(files_in(ROOT), ROOT)
        print(*faults, "clang-format is missing: skipped", sep="\n")
        sys.exit(1 if faults else 77)
    sys.exit(unittest.main())
