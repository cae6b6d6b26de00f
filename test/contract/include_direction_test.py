#!/usr/bin/python3
"""The modules depend on each other in one direction: that of the add_module lines. Reads the #include lines, and holds
every file to the namespace of its module."""
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
OWN = "spring_workbench/"
NODES = {"manipulation", "tracker_driver", "contact_sound", "register_tracker"}
ROS_MODULES = NODES | {"ros_common", "machine_link", "services", "markers", "nodes", "rviz_plugin"}
EXTERNAL = [  # headers, modules that may use them, whether their public headers may, too
    (
        re.compile(
            r"^(ros|rosbag|tf2\w*|\w+_msgs|std_srvs|dynamic_reconfigure|pluginlib|rviz"
            r"|interactive_markers|XmlRpc\w*)(/|\.h|$)"
        ),
        ROS_MODULES,
        True,
    ),
    (re.compile(r"^(bt|Bullet|LinearMath/)"), {"rigid_bodies"}, False),
    (re.compile(r"^fcl/"), {"collision"}, False),
    (re.compile(r"^SDL"), {"sound"}, False),
    (re.compile(r"^(urdf\w*|assimp)/"), {"scene"}, False),
]
YAML = re.compile(r"^yaml-cpp/")
WITHOUT_YAML = set(
    "math exponential validation geometry motion rod fork_mesh dynamics stepping bodies tools contact objects".split()
)
EXECUTABLES = {  # folders of executables, which have no module of their own: what they may use
    "rviz_plugin": {"fork_mesh", "ros_common", "tools"},
    "nodes": NODES,
    "apps": {"live", "motion_files", "simulated_fastrak", "assembly"},
}
# A pose enters each module once: hand_input is entered by these headers, from these modules. Gate, smoothing,
# re-acquisition and playout clock are the input filter's own, and what hands a pose on towards it knows none of them.
ENTRIES = {
    "hand_input": {
        "input_filter.h": {"live", "assembly", "apps"},
        "settings.h": {"manipulation", "live", "apps"},
        "local_time.h": {"ros_common"},
    }
}
PICTURE = re.compile(r"^## The path of a pose$.*?^```mermaid$(.*?)^```$", re.MULTILINE | re.DOTALL)
WAY = ["fastrak", "tracker_driver", "manipulation", "live", "hand_input", "simulation"]
# Includes for users of the library; no module includes it.
UMBRELLA = "spring_workbench.h"
# The few names that every module has in common are in the namespace above the modules.
COMMON_NAMES = {"include/spring_workbench/math/rigid_transform.h", "include/spring_workbench/math/spatial.h"}


def modules_of(cmake_text):
    """Name -> (folder, modules that it may use directly), from add_module(name FOLDER f DEPENDS a b LIBRARIES ...)."""
    modules = {}
    for arguments in re.findall(r"^\s*add_module\(([^)]*)\)", cmake_text, re.MULTILINE):
        name, *words = arguments.split()
        depends = []
        if "DEPENDS" in words:
            for word in words[words.index("DEPENDS") + 1 :]:
                if word.isupper():
                    break
                depends.append(word)
        folder = words[words.index("FOLDER") + 1] if "FOLDER" in words else name
        modules[name] = (folder, set(depends))
    return modules


def reach(uses, module):
    """The module and everything that it may use, directly or indirectly."""
    found, to_do = set(), [module]
    while to_do:
        name = to_do.pop()
        if name not in found:
            found.add(name)
            to_do.extend(uses.get(name, ()))
    return found


class Layout:
    """The module of a file, and what it may use."""

    def __init__(self, root):
        cmake = [root / "CMakeLists.txt", *sorted((root / "cmake").glob("*.cmake"))]
        modules = modules_of("".join(path.read_text() for path in cmake))
        self.folders = {folder: name for name, (folder, _) in modules.items()}
        self.uses = {**{name: uses for name, (_, uses) in modules.items()}, **EXECUTABLES}

    def module_of(self, path):
        """Module of a path below src or include/spring_workbench; None if there is none."""
        for parent in path.parents:
            if str(parent) in self.folders:
                return self.folders[str(parent)]
        return path.parts[0] if path.parts[0] in EXECUTABLES else None


def find_faults(root):
    layout = Layout(root)
    faults, files = [], 0
    for base in ["include/spring_workbench", "src"]:
        for path in sorted(p for p in (root / base).rglob("*") if p.suffix in {".h", ".cpp"}):
            files += 1
            name = path.relative_to(root)
            if str(path.relative_to(root / base)) == UMBRELLA:
                continue
            module = layout.module_of(path.relative_to(root / base))
            if module is None:
                faults.append(f"{name}: in the folder of no module: an add_module line must name it")
                continue
            text = path.read_text()
            faults += [f"{name}:{n}: {reason}" for n, reason in include_faults(text, module, path, base, layout)]
            if module not in EXECUTABLES and str(name) not in COMMON_NAMES:
                opened = set(re.findall(r"^namespace (spring_workbench[\w:]*) \{", text, re.MULTILINE))
                if opened - {f"spring_workbench::{module}"}:
                    faults.append(f"{name}: opens {', '.join(sorted(opened))}: must be spring_workbench::{module}")
    return faults, files


def include_faults(text, module, path, base, layout):
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        reason = match and fault_of(match.group(1), module, path, base == "src", layout)
        if reason:
            yield number, f"{module} includes {match.group(1)}: {reason}"


def fault_of(header, module, path, private, layout):
    if header.startswith(OWN):
        inside = pathlib.Path(header[len(OWN) :])
        if header == OWN + UMBRELLA:
            return "is for users of the library"
        if len(inside.parts) == 1:  # generated from a message or service
            of_ros = module in ROS_MODULES or "bags" in pathlib.Path(path).parts
            return None if of_ros else "messages belong to the ROS side"
        allowed, other = reach(layout.uses, module), layout.module_of(inside)
        if other not in allowed:
            return f"must be one of {', '.join(sorted(allowed))}"
        if other in ENTRIES and other != module and module not in ENTRIES[other].get(inside.name, ()):
            return f"{other} is entered by {', '.join(sorted(ENTRIES[other]))}, each from its own users alone"
        return None
    if module == "apps" and "bag" in path.stem and EXTERNAL[0][0].match(header):
        return None
    if YAML.match(header) and module in WITHOUT_YAML:
        return "knows no YAML"
    for pattern, users, in_public in EXTERNAL:
        if pattern.match(header) and (module not in users or not (private or in_public)):
            return f"only in {', '.join(sorted(users))}" + ("" if in_public else ", in src/ alone")
    return None


def picture_faults(text, uses):
    """Faults of the diagram of a pose's path: arrows without a link dependency, a second path into a module."""
    arrows = re.findall(r"^  (\w+) --> (\w+)$", PICTURE.search(text).group(1), re.MULTILINE)
    faults = [f"no arrow from {module}" for module in WAY if module not in dict(arrows)]
    entered = [to for _, to in arrows]
    faults += [f"{module} is entered {entered.count(module)} times" for module in uses if entered.count(module) > 1]
    for start, end in arrows:
        if {start, end} <= set(uses) and end not in reach(uses, start) and start not in reach(uses, end):
            faults.append(f"{start} --> {end}: neither may use the other")
    return faults


class IncludeDirection(unittest.TestCase):
    def test_this_package_keeps_it(self):
        faults, files = find_faults(ROOT)
        self.assertGreater(files, 30)
        self.assertEqual(faults, [], "\n" + "\n".join(faults))

    def test_modules_have_no_circle(self):
        uses = Layout(ROOT).uses
        self.assertIn("simulation", uses)
        for module, others in uses.items():
            for other in others:
                self.assertNotIn(module, reach(uses, other), f"{module} -> {other} closes a circle")

    def test_a_pose_enters_each_module_once(self):
        text, uses = (ROOT / "doc/architecture.md").read_text(), Layout(ROOT).uses
        self.assertEqual(picture_faults(text, uses), [])
        for arrow in ["tracker_driver --> hand_input", "fastrak --> rod"]:
            spoilt = text.replace("  hand_input --> simulation\n", f"  hand_input --> simulation\n  {arrow}\n")
            self.assertEqual(len(picture_faults(spoilt, uses)), 2 if "rod" in arrow else 1, arrow)

    def test_faults_are_found(self):
        cases = [  # file, line, whether it is a fault
            ("src/low/a.cpp", '#include "spring_workbench/low/a.h"', False),
            ("src/high/a.cpp", '#include "spring_workbench/low/a.h"', False),
            ("src/low/a.cpp", '#include "spring_workbench/high/a.h"', True),
            ("src/ros/top/a.cpp", '#include "spring_workbench/high/a.h"', False),
            ("src/high/a.cpp", '#include "spring_workbench/ros/top/a.h"', True),
            ("include/spring_workbench/low/a.h", "#  include <ros/ros.h>", True),
            ("src/low/a.cpp", "#include <geometry_msgs/Pose.h>", True),
            ("src/low/a.cpp", '#include "spring_workbench/ForkState.h"', True),
            ("src/nodes/a.cpp", '#include "spring_workbench/spring_workbench.h"', True),
            ("include/spring_workbench/spring_workbench.h", '#include "spring_workbench/high/a.h"', False),
            ("src/low/a.cpp", "#include <fcl/fcl.h>", True),
            ("src/collision/a.cpp", "#include <fcl/fcl.h>", False),
            ("include/spring_workbench/collision/a.h", "#include <fcl/fcl.h>", True),
            ("src/rod/a.cpp", "#include <yaml-cpp/yaml.h>", True),
            ("src/nodes/a.cpp", "#include <ros/ros.h>", False),
            ("src/apps/bag_reader.cpp", "#include <rosbag/bag.h>", False),
            ("src/apps/main.cpp", "#include <rosbag/bag.h>", True),
            ("src/assembly/a.cpp", '#include "spring_workbench/hand_input/input_filter.h"', False),
            ("src/assembly/a.cpp", '#include "spring_workbench/hand_input/sample_gate.h"', True),
            ("src/fastrak/a.cpp", '#include "spring_workbench/hand_input/input_filter.h"', True),
            ("src/hand_input/a.cpp", '#include "spring_workbench/hand_input/sample_gate.h"', False),
            ("src/stray/a.cpp", "#include <vector>", True),
            ("src/low/a.cpp", "namespace spring_workbench::low {", False),
            ("src/low/a.cpp", "namespace spring_workbench::high {", True),
            ("src/low/a.cpp", "namespace spring_workbench {", True),
        ]
        for file, line, wrong in cases:
            with self.subTest(file=file, line=line), tempfile.TemporaryDirectory() as folder:
                root = pathlib.Path(folder)
                (root / "CMakeLists.txt").write_text(
                    "add_module(low)\nadd_module(rod)\nadd_module(collision DEPENDS low)\n"
                    "add_module(hand_input)\nadd_module(assembly DEPENDS hand_input)\n"
                    "add_module(fastrak DEPENDS hand_input)\n"
                    "add_module(high DEPENDS low LIBRARIES x)\nadd_module(top FOLDER ros/top DEPENDS high)\n"
                )
                (root / file).parent.mkdir(parents=True)
                (root / file).write_text(line + "\n")
                self.assertEqual(len(find_faults(root)[0]), 1 if wrong else 0)


if __name__ == "__main__":
    sys.exit(unittest.main())
