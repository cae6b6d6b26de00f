#!/usr/bin/env python3
"""What the documents name is there: links and their anchors; in code blocks, the project's scripts, launch files and
their arguments, programs and files. Numbers: numbers_test.py."""
import pathlib
import re
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.M | re.S)


def documents(root):
    found = [root / name for name in ("README.md", "CONTRIBUTING.md")]
    for folder in ("doc", "benchmark", "examples"):
        found += sorted((root / folder).rglob("*.md"))
    return [path for path in found if path.exists()]


def anchors(path):
    """What a heading is called in a link, as the forges do it."""
    text = FENCE.sub("", path.read_text())
    names = set(re.findall(r'<a id="([^"]+)"', text))
    for heading in re.findall(r"^#+ (.*)$", text, re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        names.add(re.sub(r"[^\w\- ]", "", heading).replace(" ", "-"))
    return names


def broken_links(path):
    for link in LINK.findall(FENCE.sub("", path.read_text())):
        if re.match(r"(https?|mailto):", link):
            continue
        target, _, anchor = link.partition("#")
        there = (path.parent / target) if target else path
        if not there.exists():
            yield f"{path}: {link}: no such file"
        elif anchor and there.suffix == ".md" and anchor not in anchors(there):
            yield f"{path}: {link}: no such heading"


def launch_arguments(path):
    """Names of the arguments of a launch file."""
    return {arg.get("name") for arg in ElementTree.parse(path).iter("arg") if arg.get("name")}


def programs(root):
    """Names that `rosrun` and `build/devel/lib` know."""
    names = {path.stem for path in (root / "src/nodes").glob("*.cpp")}
    names |= {path.name for path in (root / "src/apps").iterdir() if path.is_dir()}
    for folder in ("benchmark", "test"):
        for file in (root / folder).rglob("CMakeLists.txt"):
            names |= set(re.findall(r"add_(?:executable|gtest)\((\w+)", file.read_text()))
    names |= {"test_" + path.name for path in (root / "test/unit").glob("*")}
    return names


def wrong_commands(path, root):
    for language, block in FENCE.findall(path.read_text()):
        if language not in ("", "bash", "sh", "console"):
            continue
        for line in block.replace("\\\n", " ").splitlines():
            line = line.split(" # ")[0]
            for script in re.findall(r"(?<![\w./])((?:scripts|\.ci|examples|benchmark)/[\w./]+)", line):
                if not (root / script).exists():
                    yield f"{path}: {script}: no such file"
            launch = re.search(r"roslaunch (?:\S+ )*?spring_workbench (\w+\.launch)(.*)", line)
            if launch:
                file = root / "launch" / launch.group(1)
                if not file.exists():
                    yield f"{path}: {launch.group(1)}: no such launch file"
                    continue
                for argument in re.findall(r"(\w+):=", launch.group(2)):
                    if argument not in launch_arguments(file):
                        yield f"{path}: {launch.group(1)} has no argument {argument}"
            for program in re.findall(r"rosrun spring_workbench (\w+)|lib/spring_workbench/(\w+)", line):
                name = program[0] or program[1]
                if name not in programs(root):
                    yield f"{path}: {name}: no such program"
            for file in re.findall(r"(?:\$PWD/|\s)((?:config|scenes)/[\w./]+)", line):
                if not (root / file).exists():
                    yield f"{path}: {file}: no such file"


class Documents(unittest.TestCase):
    def test_links_lead_somewhere(self):
        self.assertEqual([fault for path in documents(ROOT) for fault in broken_links(path)], [])

    def test_commands_are_there(self):
        self.assertEqual([fault for path in documents(ROOT) for fault in wrong_commands(path, ROOT)], [])

    def test_faults_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name in ("launch", "src/nodes", "src/apps"):
                (root / name).mkdir(parents=True)
            (root / "launch/x.launch").write_text('<launch><arg name="scene"/></launch>')
            path = root / "README.md"
            path.write_text(
                "# A heading\n[x](nowhere.md) [y](#a-heading) [z](#none)\n"
                "```bash\nscripts/none\nroslaunch spring_workbench x.launch scene:=a step:=b\n"
                "rosrun spring_workbench nothing\n```\n"
            )
            self.assertEqual(len(list(broken_links(path))), 2)
            self.assertEqual(len(list(wrong_commands(path, root))), 3)


if __name__ == "__main__":
    unittest.main()
