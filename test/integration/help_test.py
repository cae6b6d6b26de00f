#!/usr/bin/python3
"""Every program and node says what it is for `--help` and `-h`, in lines that a terminal shows, and ends, even without
a ROS master. Usage: help_test.py PROGRAM..."""
import os
import subprocess
import sys
import unittest

PROGRAMS = sys.argv[1:]
DEADLINE = 60.0  # [s]


class Help(unittest.TestCase):
    def test_each_program_prints_its_help_and_ends(self):
        self.assertGreater(len(PROGRAMS), 2)
        how = {"capture_output": True, "text": True, "timeout": DEADLINE}
        how["env"] = dict(os.environ, ROS_MASTER_URI="http://localhost:9")  # where nothing listens
        for program in PROGRAMS:
            with self.subTest(program=program):
                done = subprocess.run([program, "--help"], **how)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn(os.path.basename(program), done.stdout)
                self.assertLessEqual(max(map(len, done.stdout.splitlines())), 120)
                self.assertEqual(subprocess.run([program, "-h"], **how).stdout, done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
