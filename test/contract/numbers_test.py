#!/usr/bin/python3
"""Every number in a document that has a marker equals the value in its table (benchmark/report/document_numbers.py)."""
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "benchmark/report/document_numbers.py"
spec = importlib.util.spec_from_file_location("numbers_of_documents", PROGRAM)
numbers = importlib.util.module_from_spec(spec)
spec.loader.exec_module(numbers)

TABLE = '# machine: any\nkind,"depth [um]",n\nstack,12.4,3\nstack,9.6,3e0\nwall,21,12345.6\n'


class Documents(unittest.TestCase):
    def test_are_up_to_date(self):
        run = subprocess.run([sys.executable, PROGRAM], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_have_markers(self):
        least = {"README.md": 12, "benchmark/README.md": 10}
        least.update({"doc/accuracy.md": 30, "doc/model.md": 80, "doc/tracker.md": 30})
        for name, count in least.items():
            text = (ROOT / name).read_text(encoding="utf-8")
            marked = [kind.findall(text) for kind in (numbers.MARKER, numbers.ALL, numbers.LESS, numbers.ROWS)]
            self.assertGreaterEqual(sum(map(len, marked)), count, name)

    def test_tables_of_one_run_are_of_one_commit(self):
        tables = sorted((ROOT / numbers.RESULTS).glob("*.csv"))
        self.assertEqual(len({numbers.commit_of(table) for table in tables}), 1)

    def test_every_table_says_how_it_was_made(self):
        for table in sorted((ROOT / numbers.RESULTS).rglob("*.csv")):
            header = [line for line in table.read_text(encoding="utf-8").splitlines() if line.startswith("# ")]
            for what in ("machine", "date", "command", "commit"):
                self.assertTrue(any(re.match(rf"# {what}: \S", line) for line in header), f"{table.name}: no {what}")


class Markers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = pathlib.Path(folder.name)
        (self.results / "t.csv").write_text(TABLE, encoding="utf-8")

    def check(self, text):
        return numbers.checked(text, self.results)

    def test_correct_numbers_are_kept(self):
        for text in (
            "12 µm<!-- max depth [um] of t.csv where kind=stack --> deep",
            "at 9.6 <!-- min depth [um] of t.csv -->",
            "11.0 <!-- mean depth [um] of t.csv where kind=stack -->",
            "| 2.1e-5 m <!-- the depth [um] of t.csv where kind=wall times 1e-6 --> |",
            "12,346 <!-- the n of t.csv where kind=wall -->",
            "3 of them: 10 <!-- the depth [um] of t.csv where depth [um]=9.6, n=3 -->",
            "2<!-- count n of t.csv where kind=stack --> of 3<!-- count kind of t.csv -->",
            "a remark <!-- without a table --> 5",
            "22.0<!-- sum depth [um] of t.csv where kind=stack --> of 43<!-- sum depth [um] of t.csv -->",
        ):
            self.assertEqual(self.check(text), (text, []))

    def test_rows_are_made_and_reported_if_stale_or_missing(self):
        text = "a\n<!-- rows kind, n of t.csv where kind=stack -->\n%s<!-- end of rows -->\nb"
        table = "| kind | n |\n| --- | --- |\n| stack | 3 |\n| stack | 3e0 |\n"
        self.assertEqual(self.check(text % table), (text % table, []))
        mended, wrong = self.check(text % "| kind | n |\n")
        self.assertEqual(mended, text % table)
        self.assertEqual(len(wrong), 1)
        for bad in (text.replace("stack", "floor"), text.replace("kind, n", "kind, m"), text.replace("t.csv", "u.csv")):
            same, wrong = self.check(bad % table)
            self.assertEqual((same, len(wrong)), (bad % table, 1))

    def test_false_comparisons_are_reported(self):
        for text in (
            "all<!-- all n=3 of t.csv where kind=stack --> and<!-- all kind~^(stack|wall)$ of t.csv -->",
            "but<!-- all n~^1 of t.csv where kind~^w, depth [um]=21 --> this",
            "less<!-- less max depth [um] of t.csv where kind=stack than min depth [um] of t.csv where kind=wall -->",
            "fewer<!-- less count n of t.csv where kind=wall than count n of t.csv -->",
        ):
            self.assertEqual(self.check(text), (text, []))
        for text, word in (
            ("all<!-- all n=3 of t.csv -->", "untrue for 1 of 3, first wall | 21 | 12345.6"),
            ("none<!-- all n=3 of t.csv where kind~pile -->", "no such row"),
            ("<!-- all colour=red of t.csv -->", "no column colour"),
            ("<!-- all n=3 of none.csv -->", "no table"),
            ("<!-- less max n of t.csv than min n of t.csv -->", "untrue, 12345.6 is no less than 3"),
            ("<!-- less max n of t.csv than min width of t.csv -->", "no column width"),
            ("<!-- more max n of t.csv than min n of t.csv -->", "not understood"),
        ):
            same, wrong = self.check(text)
            self.assertEqual(same, text)
            self.assertEqual(len(wrong), 1, wrong)
            self.assertIn(word, wrong[0])

    def test_the_header_of_a_table_says_how_it_was_made(self):
        for command, word, other in (("report --quick", "quick", "full"), ("report --shard 1/2", "full", "quick")):
            (self.results / "t.csv").write_text(f"# command: {command}\n" + TABLE, encoding="utf-8")
            text = "of the %s<!-- run of t.csv --> run, 3<!-- count kind of t.csv -->"
            self.assertEqual(self.check(text % word), (text % word, []))
            mended, wrong = self.check(text % other)
            self.assertEqual((mended, len(wrong)), (text % word, 1))
        for bad in ("of the <!-- run of t.csv --> run", "of the full<!-- run of none.csv --> run"):
            same, wrong = self.check(bad)
            self.assertEqual((same, len(wrong)), (bad, 1))
        (self.results / "t.csv").write_text(TABLE, encoding="utf-8")
        self.assertEqual(len(self.check("full<!-- run of t.csv -->")[1]), 1)

    def test_a_word_is_that_of_the_one_row_chosen(self):
        text = "a %s<!-- word kind of t.csv where n=3, depth [um]=9.6 --> of 3<!-- count kind of t.csv -->"
        self.assertEqual(self.check(text % "stack"), (text % "stack", []))
        mended, wrong = self.check(text % "wall")
        self.assertEqual((mended, len(wrong)), (text % "stack", 1))
        for bad in ("a stack<!-- word kind of t.csv where n=3 -->", "a<!-- word colour of t.csv where kind=wall -->"):
            same, wrong = self.check(bad)
            self.assertEqual((same, len(wrong)), (bad, 1))

    def test_the_header_names_the_commit(self):
        table = self.results / "t.csv"
        self.assertIsNone(numbers.commit_of(table))
        table.write_text("# commit: abc123\n" + TABLE, encoding="utf-8")
        self.assertEqual(numbers.commit_of(table), "abc123")

    def test_stale_numbers_are_reported_and_updated(self):
        text = (
            "1 and 13 µm<!-- max depth [um] of t.csv where kind=stack -->, "
            "2.0e-5<!-- max depth [um] of t.csv times 1e-6 -->"
        )
        mended, wrong = self.check("first line\n" + text)
        self.assertEqual(len(wrong), 2)
        self.assertTrue(all(what.startswith("2: ") for what in wrong), wrong)
        self.assertEqual(mended, "first line\n" + text.replace("13 µm", "12 µm").replace("2.0e-5", "2.1e-5"))
        self.assertEqual(self.check(mended), (mended, []))

    def test_markers_without_a_number_are_reported(self):
        for marker, word in (
            ("<!-- the depth [um] of t.csv where kind=stack -->", "not one"),
            ("<!-- max depth [um] of none.csv -->", "no table"),
            ("<!-- max width of t.csv -->", "no column width"),
            ("<!-- max n of t.csv where colour=red -->", "no column colour"),
            ("<!-- max n of t.csv where kind=pile -->", "no such row"),
            ("<!-- max kind of t.csv -->", "no number"),
            ("<!-- largest n of t.csv -->", "not understood"),
        ):
            text = "7 " + marker
            mended, wrong = self.check(text)
            self.assertEqual(mended, text)
            self.assertIn(word, "".join(wrong), marker)
        self.assertIn("no number before", "".join(self.check("<!-- max n of t.csv -->")[1]))


if __name__ == "__main__":
    unittest.main()
