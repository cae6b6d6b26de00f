#!/usr/bin/env python3
"""package.xml names every package that the build finds (find_package, pkg_check_modules, find_path, find_library) and
the libraries that are linked by their name alone."""
import pathlib
import re
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What CMake finds, by its name there -> the key of package.xml; an empty one: it comes with the compiler or is ours.
KEYS = {
    "Boost": "libboost-dev",
    "Eigen3": "eigen",
    "GTest": "gtest",
    "PkgConfig": "pkg-config",
    "Python3": "python3-dev",
    "Qt5": "qtbase5-dev",
    "SDL2": "sdl2",
    "SPRING_WORKBENCH_BULLET_INCLUDE": "bullet",
    "SPRING_WORKBENCH_PYBIND11_INCLUDE": "pybind11-dev",
    "Threads": "",
    "X11": "libx11-dev",
    "urdfdom": "liburdfdom-dev",
    "urdfdom_headers": "liburdfdom-headers-dev",
    "spring_workbench": "",
}
LINKED = {
    "console_bridge": "libconsole-bridge-dev",
    "log4cxx": "log4cxx",
    "tinyxml": "tinyxml",
    "urdfdom_model": "liburdfdom-dev",
}
# Only the report needs these (benchmark/README.md).
OPTIONAL = {"DART", "ODE", "SUNDIALS", "SPRING_WORKBENCH_MUJOCO_INCLUDE", "SPRING_WORKBENCH_MUJOCO_LIBRARY"}
FOUND = re.compile(r"(?:find_package|pkg_check_modules|find_path|find_library)\((\w[\w-]*)(?=[\s)])(.*?)\)", re.S)


def found(root):
    names = set()
    for path in [root / "CMakeLists.txt", *(root / "cmake").glob("*.cmake"), *root.glob("*/**/CMakeLists.txt")]:
        if {"build", "examples", "data"} & set(re.split(r"[/-]", str(path.relative_to(root)))):
            continue
        text = re.sub(r"#.*", "", path.read_text())
        for name, rest in FOUND.findall(text):
            names.add(name)
            if name == "catkin":
                names |= set(re.findall(r"\b[a-z][a-z0-9_]+\b", rest))
        names |= {name for name in LINKED if re.search(rf"\b{name}\b", text)}
        for packages in re.findall(r"set\(SPRING_WORKBENCH_MESSAGE_PACKAGES([^)]*)\)", text):
            names |= set(packages.split())
    return names


def named(root):
    return {node.text for node in ElementTree.parse(root / "package.xml").getroot() if node.tag.endswith("depend")}


def missing(root):
    keys = {{**KEYS, **LINKED}.get(name, name) for name in found(root) - OPTIONAL}
    return sorted(keys - named(root) - {""})


class Package(unittest.TestCase):
    def test_names_all_that_is_found(self):
        self.assertGreater(len(found(ROOT)), 20)
        self.assertEqual(missing(ROOT), [])

    def test_is_cited_with_its_version(self):
        version = ElementTree.parse(ROOT / "package.xml").getroot().findtext("version")
        self.assertIn(f"\nversion: {version}\n", (ROOT / "CITATION.cff").read_text())

    def test_a_gap_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "package.xml").write_text("<package><depend>fcl</depend></package>")
            (root / "CMakeLists.txt").write_text("find_package(fcl)\nfind_package(Qt5 QUIET)\n")
            self.assertEqual(missing(root), ["qtbase5-dev"])


if __name__ == "__main__":
    unittest.main()
