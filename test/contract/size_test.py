#!/usr/bin/python3
"""Limits of size, for readability: no module above 2,000 lines, no class above 300 with all its files, no function
above 60, no file of the integrator above 150. size_exemptions.txt lists exceptions, their maximum size, and the change
that will remove them.

Status 77, which ctest shows as skipped, if universal-ctags is missing."""
import collections
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXEMPTIONS = pathlib.Path(__file__).with_name("size_exemptions.txt")
MOST_EXEMPTIONS = 8  # may only decrease
LIMITS = {"module": 2000, "class": 300, "function": 60, "file": 150}
# The default integrator and the equation of motion that it solves: each file is one idea.
INTEGRATOR = re.compile(
    r"exponential/|dynamics/(active_coordinates|equation_of_motion|error_spread|exponential"
    r"|held_body_\w+|linearised_motion|modal_\w+)\."
)
BASES = ["include/spring_workbench", "src"]


def sources(root):
    return sorted(p for base in BASES for p in (root / base).rglob("*") if p.suffix in {".h", ".cpp"})


def module_of(path, root):
    """The folder below src or include/spring_workbench; below ros two levels."""
    base = next(root / base for base in BASES if root / base in path.parents)
    parts = path.relative_to(base).parts
    return "/".join(parts[: 2 if parts[0] in ("ros", "apps") else 1])


def tags_of(paths):
    command = ["ctags", "--output-format=json", "--fields=+neKsZ", "--kinds-C++=fcs", "--language-force=C++", "-f", "-"]
    run = subprocess.run([*command, *map(str, paths)], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in run.stdout.splitlines()]


def length(tag):
    return tag.get("end", tag["line"]) - tag["line"] + 1


def lines_of(path):
    return len(path.read_text(encoding="utf-8").splitlines())


def sizes(root):
    """(kind, name) -> lines."""
    paths = sources(root)
    found = collections.Counter()
    for path in paths:
        found["module", module_of(path, root)] += lines_of(path)
        inside = next(path.relative_to(root / base).as_posix() for base in BASES if root / base in path.parents)
        if INTEGRATOR.match(inside):
            found["file", inside] = lines_of(path)
    bodies, members = {}, collections.defaultdict(lambda: collections.defaultdict(int))
    for tag in tags_of(paths):
        name = "::".join(filter(None, [tag.get("scope"), tag["name"]]))
        name = re.sub(r"^spring_workbench::|__anon\w+(::)?", "", name)
        if tag["kind"] in ("class", "struct"):
            bodies[name] = length(tag), tag["path"]
        else:
            found["function", name] = max(found["function", name], length(tag))
            if tag["path"].endswith(".cpp"):
                members[tag["path"]][name.rpartition("::")[0]] += length(tag)
    for name, (body, _) in bodies.items():
        found["class", name] = body
    for path, of_class in members.items():
        classes = {name: count for name, count in of_class.items() if name in bodies}
        for name, count in classes.items():
            alone = len(classes) == 1  # the whole file is this class'
            body, home = bodies[name]
            inside = body if home == path else 0  # counted already
            found["class", name] += max((lines_of(pathlib.Path(path)) if alone else count) - inside, 0)
    return found


def exemptions(text):
    """(kind, name) -> lines, from `kind name lines: what will end it`."""
    found = {}
    for line in filter(None, (line.split("#")[0].strip() for line in text.splitlines())):
        match = re.match(r"(module|class|function|file) (\S+) (\d+): \S", line)
        if not match:
            raise ValueError(f"{line}: must be 'kind name lines: what will end it'")
        found[match.group(1), match.group(2)] = int(match.group(3))
    return found


def faults_of(found, exempt):
    faults = []
    for (kind, name), size in sorted(found.items()):
        limit = exempt.get((kind, name), LIMITS[kind])
        if size > limit:
            faults.append(f"{kind} {name} has {size} lines: must be {limit} at most")
    for kind, name in sorted(exempt):
        size = found.get((kind, name), 0)
        if size <= LIMITS[kind]:
            faults.append(f"{kind} {name} has {size} lines and needs no exemption")
    return faults


class Size(unittest.TestCase):
    def test_this_package_keeps_it(self):
        found = sizes(ROOT)
        self.assertGreater(len(found), 1000)
        faults = faults_of(found, exemptions(EXEMPTIONS.read_text()))
        self.assertEqual(faults, [], "\n" + "\n".join(faults))

    def test_the_list_only_shrinks(self):
        self.assertEqual(len(exemptions(EXEMPTIONS.read_text())), MOST_EXEMPTIONS)

    def test_faults_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "src/a").mkdir(parents=True)
            (root / "include/spring_workbench/a").mkdir(parents=True)
            (root / "include/spring_workbench/a/a.h").write_text(
                "namespace spring_workbench::a {\nclass A {\n  void f();\n  void g();\n};\n}\n"
            )
            body = "namespace spring_workbench::a {\nvoid A::%s() {\n" + "  f();\n" * 150 + "}\n}\n"
            for name in "fg":
                (root / f"src/a/{name}.cpp").write_text(body % name)
            (root / "src/a/long.cpp").write_text("// long\n" * 2000)
            for module in ("exponential", "dynamics"):
                (root / "src" / module).mkdir()
                (root / f"src/{module}/exponential.h").write_text("// step\n" * 151)
                (root / f"src/{module}/constants.h").write_text("// step\n" * 150)
            found = sizes(root)
            self.assertEqual(found["class", "a::A"], 4 + 2 * 154)
            self.assertEqual(len(faults_of(found, {})), 6)  # module, class, two functions, two files
            self.assertEqual(len(faults_of(found, {("class", "a::A"): 400, ("class", "a::B"): 400})), 6)


if __name__ == "__main__":
    if not shutil.which("ctags"):
        print("universal-ctags is missing: skipped")
        sys.exit(77)
    sys.exit(unittest.main())
