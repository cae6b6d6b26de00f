#!/usr/bin/python3
"""Every number in a document that has a marker equals the value in its table or test
(benchmark/report/document_numbers.py), and a number with a unit has one, or is given: it is a condition in a marker of
the same paragraph, or listed, as often as it occurs, in given_quantities.txt (settings, constants, definitions,
targets). Text that begins with
code (`drops.h`: ...) says what that code does, and the cells of a table before the first with a marker name its row."""
import collections
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

GIVEN = ROOT / "test/contract/given_quantities.txt"
NUMBER = numbers.NUMBER.pattern
UNIT = (
    r"(?:%|°|(?:times|[µmnpk]?s|[µmnck]?m|[kMG]?N|vkg|[mk]?g|t|[kMG]?Hz|m?rad|[kMG]B|J|(?:minute|hour|second|day)s?)\b)"
)
QUANTITY = re.compile(rf"(?<![\w.])({NUMBER})(?:(?: (?:to|and|or|…) | ± )({NUMBER}))?[ -]?{UNIT}")
COMMENT = re.compile(r"<!--.*?-->", re.S)

TABLE = '# machine: any\nkind,"depth [um]",n\nstack,12.4,3\nstack,9.6,3e0\nwall,21,12345.6\n'
TEXTS = "kind,time,judged\na,26.2 ± 0.8,off 2.75 > 1 %; in 0.9 < 40 mm\nb,5 ± 1,in 3 ≥ 1 mm\n"
CODE = """TEST_P(A, Holds) {
  EXPECT_LT(x, 1.41 * y) << "of 7";  // of 8
  EXPECT_NEAR(x, y, 0.03);
}
TEST(B, Holds) { EXPECT_EQ(x, 9); }
"""


def unmarked(text):
    """The quantities in the prose of a document, such as `20 to 50 ms`, that no marker gives."""
    text = numbers.ROWS.sub("", text)
    text = re.sub(r"^```.*?^```|^#[^\n]*|(?<=\n\n)(?: {4}[^\n]*\n)+", "\n", text, flags=re.S | re.M)
    for part in map(str.strip, re.split(r"\n\s*\n|\n(?=\s*(?:[-|]|\d+\.) )", text)):
        if re.match(r"(?:[-|]|\d+\.)?\s*\**`", part):
            continue
        markers = " ".join(COMMENT.findall(part))
        if part.startswith("|") and markers:
            part = part[part.rindex("|", 0, part.index("<!--")) :]
        prose = re.sub(rf"{NUMBER}[^\d<]{{0,25}}<!--", "<!--", part)
        prose = re.sub(r"`[^`]*`|\]\([^)]*\)", "", COMMENT.sub("", prose))
        for quantity in QUANTITY.finditer(" ".join(prose.split())):
            conditions = [rf"(?<![\d.]){re.escape(number)}(?![\d.])" for number in quantity.groups() if number]
            if not all(re.search(condition, markers) for condition in conditions):
                yield quantity.group()


class Documents(unittest.TestCase):
    def test_mark_what_is_measured(self):
        given = collections.defaultdict(collections.Counter)
        for line in GIVEN.read_text(encoding="utf-8").splitlines():
            name, _, quantities = line.partition(": ")
            for quantity, _, often in (listed.partition(" (") for listed in quantities.split("; ")):
                given[name][quantity] += int(often.rstrip(")") or 1)
        for path in (path for pattern in numbers.DOCUMENTS for path in ROOT.glob(pattern)):
            name = path.relative_to(ROOT).as_posix()
            self.assertEqual(collections.Counter(unmarked(path.read_text(encoding="utf-8"))), given[name], name)

    def test_of_which_a_number_has_no_marker_are_found(self):
        for text, found in (
            ("It takes 12 ms, at most 3 to 5 times\nas long.", ["12 ms", "3 to 5 times"]),
            ("It takes 12 ms<!-- max a of t.csv --> and 7.5 %.", ["7.5 %"]),
            ("At 5 ms it is off by 12 mm<!-- the a of t.csv where step=5 -->.\n\nAt 5 ms", ["5 ms"]),
            ("- `drops.h`: up to 4 m/s\n- after 3 s", ["3 s"]),
            ("| 1 kg | 12<!-- max a of t.csv --> ms | 3 N |\n| 2 kg | 3 N |", ["3 N", "2 kg", "3 N"]),
            ("A list\n\n    run 3 s\n\n```\n4 s\n```\n## 5 s\n`6 s` and [x](7 s) Σ3 sums of 12 models", []),
        ):
            self.assertEqual(list(unmarked(text)), found)

    def test_are_up_to_date(self):
        run = subprocess.run([sys.executable, PROGRAM], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_have_markers(self):
        least = {"README.md": 12, "benchmark/README.md": 10, "benchmark/contact/README.md": 40}
        least.update({"doc/accuracy.md": 30, "doc/assembly.md": 20, "doc/model.md": 80, "doc/tracker.md": 30})
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
            self.assertFalse((numbers.commit_of(table) or "").endswith("-dirty"), table.name)


class Markers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = pathlib.Path(folder.name)
        (self.results / "t.csv").write_text(TABLE, encoding="utf-8")
        (self.results / "u.csv").write_text(TEXTS, encoding="utf-8")
        (self.results / "test").mkdir()
        (self.results / "test/a_test.cpp").write_text(CODE, encoding="utf-8")
        (self.results / "test/b_test.py").write_text('"""Of 7."""\nLIMIT = 250.0  # of 8\n', encoding="utf-8")

    def check(self, text):
        return numbers.checked(text, self.results, self.results)

    def test_a_number_of_a_test_is_in_its_code(self):
        for text in ("1.4 times<!-- test A.Holds -->, 3 %<!-- test A.Holds times 100 -->", "250 N<!-- test b_test -->"):
            self.assertEqual(self.check(text), (text, []))
        for text, word in (
            ("1.5 times<!-- test A.Holds -->", "no number of this test"),
            ("9<!-- test A.Holds -->", "no number of this test"),  # of another test, of a comment, of a text
            ("8<!-- test A.Holds -->", "no number of this test"),
            ("7<!-- test A.Holds -->", "no number of this test"),
            ("7<!-- test b_test -->", "no number of this test"),
            ("8<!-- test b_test -->", "no number of this test"),
            ("1.4 times<!-- test A.Breaks -->", "no test A.Breaks"),
            ("none<!-- test A.Holds -->", "no number before"),
            ("1.4<!-- test A.Holds or B -->", "not understood"),
        ):
            same, wrong = self.check(text)
            self.assertEqual((same, len(wrong)), (text, 1), wrong)
            self.assertIn(word, wrong[0])

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
            "26.2 s<!-- the time of u.csv where kind=a -->: 2.8 %<!-- max judged: off of u.csv where kind=a -->",
            "9 mm<!-- the judged: in of u.csv where kind=a times 10 -->, 3e0<!-- max judged: in of u.csv -->",
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
            ("<!-- max kind: in of t.csv -->", "no number"),
            ("<!-- max judged: out of u.csv -->", "no number"),
            ("<!-- max told: in of u.csv -->", "no column told: in"),
            ("<!-- largest n of t.csv -->", "not understood"),
        ):
            text = "7 " + marker
            mended, wrong = self.check(text)
            self.assertEqual(mended, text)
            self.assertIn(word, "".join(wrong), marker)
        self.assertIn("no number before", "".join(self.check("<!-- max n of t.csv -->")[1]))


if __name__ == "__main__":
    unittest.main()
