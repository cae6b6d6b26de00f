#!/usr/bin/python3
"""All constants of a module are in src/<module>/constants.h, and each names the test that detects a change."""
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Values from a standard, a device or a file format, and sizes of types: not tunable, so they stay where they are used.
FORMATS = {"fastrak/fastrak_protocol.cpp", "fastrak/fastrak_status.cpp", "fastrak/record_numbers.cpp"}
FORMATS |= {"simulated_fastrak/fastrak_device.cpp", "motion_files/motion_file.cpp", "fastrak/fastrak_protocol.h"}
FORMATS |= {"math/pack.h", "scene/scene.h", "rod/shape_model.h"}
MOST_UNNOTICED = 77  # constants that no test detects; may only decrease
TYPE = r"(?:unsigned |signed )?(?:double|float|bool|char|short|int|long|unsigned|(?:std::)?u?int\d+_t|(?:std::)?size_t)"
DEFINITION = re.compile(rf"^(?:inline |static )*const(?:expr)? (?:inline )?{TYPE} (\w+)\s*[={{][^;]*\d", re.MULTILINE)
ENTRY = re.compile(
    rf"(?P<comment>(?:^///[^\n]*\n)*)^constexpr (?P<type>{TYPE}) (?P<name>\w+) = (?P<value>[^;]*);", re.MULTILINE
)


def named_test(comment):
    """The test that the comment of a constant names, and its values; None if there is none."""
    text = " ".join(line.lstrip("/ ") for line in comment.splitlines())
    match = re.search(r"Test: ([\w.]+\.py::\w+|\w+\.\w+)(?: at ([-+\d.e, ]*\d))?\.", text)
    return match and (match.group(1), re.split(", *", match.group(2)) if match.group(2) else ["*0.5", "*2"])


def tests_of(root):
    """Suite.Name of the unit tests, file.py::method of the others."""
    found = set()
    for path in [*(root / "test").rglob("*.cpp"), *(root / "benchmark").rglob("*_test.cpp")]:
        for suite, name in re.findall(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", path.read_text(), re.MULTILINE):
            found.add(f"{suite}.{name}")
    for path in (root / "test").rglob("*_test.py"):
        found |= {f"{path.name}::{name}" for name in re.findall(r"^    def (test_\w+)", path.read_text(), re.MULTILINE)}
    return found


def faults_of(root):
    tests, faults, entries, unnoticed = tests_of(root), [], 0, 0
    for base in ["include/spring_workbench", "src"]:
        for path in sorted(p for p in (root / base).rglob("*") if p.suffix in {".h", ".cpp"}):
            inside = path.relative_to(root / base)
            if str(inside) in FORMATS:
                continue
            text = path.read_text()
            if path.name != "constants.h":
                faults += [f"{inside}: {name}: must be in constants.h" for name in DEFINITION.findall(text)]
                continue
            for entry in ENTRY.finditer(text):
                entries += 1
                test = named_test(entry["comment"])
                if re.search(r", \w+ =", entry["value"]):
                    faults.append(f"{inside}: {entry['name']}: one constant in each definition")
                if re.search(r"Test: none: \w", entry["comment"].replace("\n/// ", " ")):
                    unnoticed += 1
                elif not test:
                    faults.append(f"{inside}: {entry['name']}: its comment must name the test that notices")
                elif test[0] not in tests:
                    faults.append(f"{inside}: {entry['name']}: there is no test {test[0]}")
    return faults, entries, unnoticed


class Constants(unittest.TestCase):
    def test_this_package_keeps_it(self):
        faults, entries, unnoticed = faults_of(ROOT)
        self.assertEqual(faults, [], "\n" + "\n".join(faults))
        self.assertGreater(entries, 50)
        self.assertEqual(unnoticed, MOST_UNNOTICED)

    def test_faults_are_found(self):
        cases = [  # file, text, whether it is a fault
            ("src/a/a.cpp", "constexpr double most = 3.0;\n", True),
            ("src/a/a.cpp", "namespace {\nconst int most = 3;\n}\n", True),
            ("include/spring_workbench/a/a.h", "inline constexpr std::size_t most = 3;\n", True),
            ("src/a/a.cpp", "void f() {\n  constexpr int count = 3;\n}\n", False),
            ("src/a/a.cpp", 'const std::string name = "a";\n', False),
            ("src/a/constants.h", "/// [s] Test: A.Notices.\nconstexpr int most = 3, least = 1;\n", True),
            ("src/a/constants.h", "/// [s] Longer: later. Test: A.Notices.\nconstexpr double most = 3.0;\n", False),
            ("src/a/constants.h", "/// [s]\n/// Test: a_test.py::test_it.\nconstexpr int most = 3;\n", False),
            ("src/a/constants.h", "/// [s] Longer: later. Test: A.Sleeps.\nconstexpr double most = 3.0;\n", True),
            ("src/a/constants.h", "/// [s] Longer: later.\nconstexpr double most = 3.0;\n", True),
            ("src/ros/a/constants.h", "constexpr double most = 3.0;\n", True),
        ]
        for file, text, wrong in cases:
            with self.subTest(file=file, text=text), tempfile.TemporaryDirectory() as folder:
                root = pathlib.Path(folder)
                for name, content in [
                    ("test/unit/a_test.cpp", "TEST(A, Notices) {}\n"),
                    ("test/integration/a_test.py", "class A:\n    def test_it(self):\n"),
                    (file, text),
                ]:
                    (root / name).parent.mkdir(parents=True, exist_ok=True)
                    (root / name).write_text(content)
                self.assertEqual(len(faults_of(root)[0]), 1 if wrong else 0)


if __name__ == "__main__":
    sys.exit(unittest.main())
