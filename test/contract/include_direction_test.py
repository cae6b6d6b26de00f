#!/usr/bin/python3
"""The rooms know each other in one direction: the one of the add_room lines. Reads the #include lines."""
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
OWN = "spring_workbench/"
# What may use ROS; apps only where bags are read.
ROS_ROOMS = {"ros_interface", "nodes", "rviz_plugin"}
EXTERNAL = [  # headers, rooms that may use them, whether their public headers may as well
    (
        re.compile(
            r"^(ros|rosbag|tf2\w*|\w+_msgs|std_srvs|dynamic_reconfigure|pluginlib|rviz"
            r"|interactive_markers|XmlRpc\w*)(/|\.h|$)"
        ),
        ROS_ROOMS,
        True,
    ),
    (re.compile(r"^(bt|Bullet|LinearMath/)"), {"world"}, False),
    (re.compile(r"^fcl/"), {"collision"}, False),
    (re.compile(r"^SDL"), {"sound"}, False),
    (re.compile(r"^(urdf\w*|assimp)/"), {"scene"}, False),
]
USERS = {
    "rviz_plugin": {"fork_mesh", "tools"},
    "nodes": {"ros_interface"},
    "apps": {"simulation", "tracker", "simulated_device", "operator"},
}  # folders of executables, not rooms


def rooms_of(cmake_text):
    """Name -> rooms that it may use directly, from add_room(name DEPENDS a b LIBRARIES ...)."""
    rooms = {}
    for arguments in re.findall(r"^\s*add_room\(([^)]*)\)", cmake_text, re.MULTILINE):
        name, *words = arguments.split()
        depends = words[words.index("DEPENDS") + 1 :] if "DEPENDS" in words else []
        rooms[name] = set(depends[: depends.index("LIBRARIES")] if "LIBRARIES" in depends else depends)
    return rooms


def reach(rooms, room):
    """The room and all that it may use, directly or not."""
    found, to_do = set(), [room]
    while to_do:
        name = to_do.pop()
        if name not in found:
            found.add(name)
            to_do.extend(rooms.get(name, ()))
    return found


def find_faults(root):
    cmake_text = "".join(
        path.read_text() for path in [root / "CMakeLists.txt", *sorted((root / "cmake").glob("*.cmake"))]
    )
    rooms = {**rooms_of(cmake_text), **USERS}
    faults, files = [], 0
    for base in ["include/spring_workbench", "src"]:
        for path in sorted(p for p in (root / base).rglob("*") if p.suffix in {".h", ".cpp"}):
            files += 1
            room = path.relative_to(root / base).parts[0]
            if room not in rooms:
                faults.append(f"{path.relative_to(root)}: {room} is no room: must stand in an add_room line")
                continue
            for number, line in enumerate(path.read_text().splitlines(), 1):
                match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
                reason = match and fault_of(match.group(1), room, path, base == "src", reach(rooms, room))
                if reason:
                    faults.append(f"{path.relative_to(root)}:{number}: {room} includes {match.group(1)}: {reason}")
    return faults, files


def fault_of(header, room, path, private, allowed):
    if header.startswith(OWN):
        parts = header[len(OWN) :].split("/")
        if len(parts) == 1:  # generated from a message or service
            return None if room in ROS_ROOMS else "messages belong to the ROS side"
        return None if parts[0] in allowed else f"must be one of {', '.join(sorted(allowed))}"
    if room == "apps" and "bag" in path.stem and EXTERNAL[0][0].match(header):
        return None
    for pattern, users, in_public in EXTERNAL:
        if pattern.match(header) and (room not in users or not (private or in_public)):
            return f"only in {', '.join(sorted(users))}" + ("" if in_public else ", in src/ alone")
    return None


class IncludeDirection(unittest.TestCase):
    def test_this_package_keeps_it(self):
        faults, files = find_faults(ROOT)
        self.assertGreater(files, 30)
        self.assertEqual(faults, [], "\n" + "\n".join(faults))

    def test_rooms_have_no_circle(self):
        rooms = rooms_of((ROOT / "CMakeLists.txt").read_text())
        self.assertIn("simulation", rooms)
        for room, uses in rooms.items():
            for other in uses:
                self.assertNotIn(room, reach(rooms, other), f"{room} -> {other} closes a circle")

    def test_arrows_the_wrong_way_are_found(self):
        cases = [  # file, include line, whether it is a fault
            ("src/low/a.cpp", '#include "spring_workbench/low/a.h"', False),
            ("src/high/a.cpp", '#include "spring_workbench/low/a.h"', False),
            ("src/low/a.cpp", '#include "spring_workbench/high/a.h"', True),
            ("include/spring_workbench/low/a.h", "#  include <ros/ros.h>", True),
            ("src/low/a.cpp", "#include <geometry_msgs/Pose.h>", True),
            ("src/low/a.cpp", '#include "spring_workbench/ForkState.h"', True),
            ("src/low/a.cpp", "#include <fcl/fcl.h>", True),
            ("src/collision/a.cpp", "#include <fcl/fcl.h>", False),
            ("include/spring_workbench/collision/a.h", "#include <fcl/fcl.h>", True),
            ("src/nodes/a.cpp", "#include <ros/ros.h>", False),
            ("src/apps/bag_reader.cpp", "#include <rosbag/bag.h>", False),
            ("src/apps/main.cpp", "#include <rosbag/bag.h>", True),
            ("src/stray/a.cpp", "#include <vector>", True),
        ]
        for file, line, wrong in cases:
            with self.subTest(file=file, line=line), tempfile.TemporaryDirectory() as folder:
                root = pathlib.Path(folder)
                (root / "CMakeLists.txt").write_text(
                    "add_room(low)\nadd_room(collision DEPENDS low)\n" "add_room(high DEPENDS low LIBRARIES x)\n"
                )
                (root / file).parent.mkdir(parents=True)
                (root / file).write_text(line + "\n")
                self.assertEqual(len(find_faults(root)[0]), 1 if wrong else 0)


if __name__ == "__main__":
    sys.exit(unittest.main())
