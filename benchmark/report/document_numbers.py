#!/usr/bin/env python3
"""Numbers in documents that come from a table of benchmark/results carry a marker right behind them, invisible when the
document is shown:

    in 12 µm<!-- max penetration_um of contact_limit_cases.csv where limit_case=stack of ten --> at most

`the`, `max`, `min`, `mean` or `sum` of a column, over the rows where all the cells named are as said (numbers as
numbers), or match a pattern (`claim~^Rod .* samples`); `the` wants one row alone; `count` is how many rows have
anything in that column. `times X` at the end gives another unit. The number is the last one before the marker, and must
be what the table says, rounded to as many digits as it has. Of a cell like `26.2 ± 0.8` the mean counts. A number in a
text is found by the words before it, after the column and a colon:

    2.75 %<!-- max judged: force off the exact one of contact/wedge.csv -->

A number that a test asserts is one of the code of that test, a gtest or a whole Python file without its ending:

    1.4 times<!-- test Calibration.EveryDirectionSettlesAlike -->

`run` is no number but `quick` or `full`: how the report was run that wrote the table, by the command in its header.

    of a quick<!-- run of checks.csv --> run

`word` is no number either, but what the one row chosen has in a column, the last word before the marker:

    against rk4<!-- word baseline of checks.csv where claim~^Scene A × 1, result=FAIL -->

Whole rows stand between two markers, each on a line of its own:

    <!-- rows claim, measured of checks.csv where result=FAIL -->
    (the table, which --write makes)
    <!-- end of rows -->

Sentences that compare have a marker, too, which says what must hold for them to be true, of all chosen rows or of two
values:

    is the fastest<!-- all result=PASS of checks.csv where claim~^Rod stiff.*every baseline -->
    is cheaper<!-- less max us of t.csv where method=ode than min us of t.csv where method=stop -->

Usage: document_numbers.py reports stale numbers and invalid markers; status 1 if there are any
       document_numbers.py --write    puts the tables' numbers in"""
import csv
import math
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
RESULTS = "benchmark/results"
DOCUMENTS = [
    "README.md",
    "CONTRIBUTING.md",
    "benchmark/README.md",
    "benchmark/contact/README.md",
    "doc/*.md",
    "doc/tutorials/*.md",
]
VALUE = r"(the|max|min|mean|sum|count)\s+(.+?)\s+of\s+(\S+\.csv)(?:\s+where\s+(.+?))?"
MARKER = re.compile(rf"<!--\s*{VALUE}(?:\s+times\s+([-+.\deE]+))?\s*-->")
TEST = re.compile(r"<!--\s*test\s+([\w.]+)(?:\s+times\s+([-+.\deE]+))?\s*-->")
ALL = re.compile(r"<!--\s*all\s+(.+?)\s+of\s+(\S+\.csv)(?:\s+where\s+(.+?))?\s*-->")
LESS = re.compile(rf"<!--\s*less\s+{VALUE}\s+than\s+{VALUE}\s*-->")
WORD = re.compile(r"<!--\s*word\s+(.+?)\s+of\s+(\S+\.csv)(?:\s+where\s+(.+?))?\s*-->")
RUN = re.compile(r"<!--\s*run\s+of\s+(\S+\.csv)\s*-->")
ROWS = re.compile(r"(<!-- rows (.+?) of (\S+\.csv)(?: where (.+?))? -->\n)(.*?)(<!-- end of rows -->)", re.S)
NUMBER = re.compile(r"\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?")


class Stale(Exception):
    """A fault of a marker."""


def rows_of(path):
    if not path.is_file():
        raise Stale(f"no table {path.name}")
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def run_of(path):
    """How the report that wrote a table was run: quick or full."""
    if not path.is_file():
        raise Stale(f"no table {path.name}")
    with path.open(encoding="utf-8") as file:
        command = next((line for line in file if line.startswith("# command: report")), None)
    if command is None:
        raise Stale(f"{path.name} does not say how it was made")
    return "quick" if "--quick" in command else "full"


def commit_of(path):
    """The commit that a table's header names; None without one."""
    with path.open(encoding="utf-8") as file:
        return next((line[len("# commit: ") :].strip() for line in file if line.startswith("# commit: ")), None)


def same(cell, wanted):
    try:
        return float(cell) == float(wanted)
    except ValueError:
        return cell == wanted


def condition_of(text, rows, table):
    """Parses a condition on rows, `column=value` or `column~pattern`."""
    key, sign, wanted = re.fullmatch(r"([^=~]*)([=~]?)(.*)", text.strip()).groups()
    if rows and key not in rows[0]:
        raise Stale(f"{table} has no column {key}")
    return lambda row: re.search(wanted, row[key]) is not None if sign == "~" else same(row[key], wanted)


def chosen(table, where, results):
    """The rows of a table whose cells meet all conditions."""
    rows = rows_of(results / table)
    for text in filter(None, (part.strip() for part in (where or "").split(","))):
        rows = list(filter(condition_of(text, rows, table), rows))
    if not rows:
        raise Stale(f"no such row in {table}")
    return rows


def number_in(row, column):
    """The number in a column, or in its text right after the words behind a colon in `column`; None without one."""
    name, colon, words = (column, "", "") if column in row else column.partition(": ")
    text = row.get(name, "")
    found = re.search(rf"(?:^|; ){re.escape(words)} ([-+.\deE]+)", text) if colon else re.match(r"(\S+) ± ", text)
    try:
        return float(found.group(1) if found else text)
    except ValueError:
        return None


def tested(name, root):
    """The numbers in the code of a test: a gtest, or a Python file."""
    for path in sorted(path for folder in ("test", "benchmark") for path in (root / folder).rglob("*.*")):
        if path.stem == name and path.suffix == ".py":
            code = re.sub(r'"""[\s\S]*?"""|#.*', "", path.read_text(encoding="utf-8"))
        elif path.suffix == ".cpp" and "." in name:
            head = r"^TEST(?:_F|_P)?\({}, {}\)".format(*map(re.escape, name.split(".", 1)))
            body = re.search(head + r"([\s\S]*?)^}", path.read_text(encoding="utf-8"), re.M)
            code = body and re.sub(r'"(?:\\.|[^"\\])*"|//.*', "", body.group(1))
        else:
            continue
        if code:
            return [float(number) for number in re.findall(r"(?<![\w.])\d+(?:\.\d*)?(?:e[-+]?\d+)?", code)]
    raise Stale(f"no test {name}")


def number_of_test(text, name, times, root):
    """`text`, if the test has that number."""
    if text not in [written_like(text, number * float(times or 1.0)) for number in tested(name, root)]:
        raise Stale(f"{text} is no number of this test")
    return text


def table_of(marker, results):
    """The table between two markers (a match of ROWS)."""
    columns = [column.strip() for column in marker.group(2).split(",")]
    rows = chosen(marker.group(3), marker.group(4), results)
    for column in columns:
        if column not in rows[0]:
            raise Stale(f"{marker.group(3)} has no column {column}")
    cells = [columns, ["---"] * len(columns)]
    cells += [[row[column].replace("|", "\\|") for column in columns] for row in rows]
    return "".join("| " + " | ".join(row) + " |\n" for row in cells)


def value_of(kind, column, table, where, times, results):
    """The number that a marker stands for: the groups of MARKER."""
    rows = chosen(table, where, results)
    if column not in rows[0] and column.partition(": ")[0] not in rows[0]:
        raise Stale(f"{table} has no column {column}")
    if kind == "the" and len(rows) > 1:
        raise Stale(f"{len(rows)} such rows in {table}, not one")
    if kind == "count":
        return sum(row[column] != "" for row in rows) * float(times or 1.0)
    values = [number_in(row, column) for row in rows]
    if None in values:
        raise Stale(f"{column} of {table} is no number")
    of_kind = {"the": max, "max": max, "min": min, "sum": sum, "mean": lambda v: sum(v) / len(v)}
    return of_kind[kind](values) * float(times or 1.0)


def false_sentences(line, results):
    """The false comparisons of the markers in a line."""
    for marker in ALL.finditer(line):
        try:
            rows = chosen(*marker.groups()[1:], results)
            holds = condition_of(marker.group(1), rows, marker.group(2))
            others = [row for row in rows if not holds(row)]
            if others:
                first = " | ".join(others[0].values())
                yield f"untrue for {len(others)} of {len(rows)}, first {first}: {marker.group()}"
        except Stale as what:
            yield f"{what}: {marker.group()}"
    for marker in LESS.finditer(line):
        try:
            low, high = (value_of(*marker.groups()[at : at + 4], None, results) for at in (0, 4))
            if not low < high:
                yield f"untrue, {low:g} is no less than {high:g}: {marker.group()}"
        except Stale as what:
            yield f"{what}: {marker.group()}"


def written_like(text, value):
    """`value` with as many digits as the number `text` has."""
    mantissa, is_power, _ = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    if is_power:
        if value == 0.0:
            return "0"
        digits, _, exponent = f"{value:.{decimals}e}".partition("e")
        return f"{digits}e{int(exponent)}"
    if not math.isfinite(value):
        raise Stale("the table's number is not finite")
    return f"{value:,.{decimals}f}" if "," in text else f"{value:.{decimals}f}"


def word_of(column, table, where, results):
    """What the one row chosen has in a column."""
    rows = chosen(table, where, results)
    if column not in rows[0]:
        raise Stale(f"{table} has no column {column}")
    if len(rows) > 1:
        raise Stale(f"{len(rows)} such rows in {table}, not one")
    return rows[0][column]


def filled(line, number, wrong, marker_of, what, what_is):
    """The line with what stands before the markers of one kind filled in, a word or a number: `what_is` gives it, of a
    match and of what there is."""
    done, at = "", 0
    for marker in marker_of.finditer(line):
        before = line[at : marker.start()]
        at = marker.end()
        found = (list(NUMBER.finditer(before)) if what == "number" else list(re.finditer(r"[\w.-]+$", before)))[-1:]
        try:
            if not found:
                raise Stale(f"no {what} before the marker")
            is_there = found[0].group()
            now = what_is(marker, is_there)
            if now != is_there:
                wrong.append(f"{number}: {is_there} is stale: {now} by {marker.group()}")
                before = before[: found[0].start()] + now + before[found[0].end() :]
        except Stale as what_else:
            wrong.append(f"{number}: {what_else}: {marker.group()}")
        done += before + marker.group()
    return done + line[at:]


def checked(text, results, root=ROOT):
    """Returns the text with the tables' numbers, and its faults line by line. `root` has the tests."""
    lines, wrong = [], []

    def made(marker):
        number = text[: marker.start()].count("\n") + 1
        try:
            table = table_of(marker, results)
        except Stale as what:
            wrong.append(f"{number}: {what}: {marker.group(1).strip()}")
            return marker.group()
        if table != marker.group(5):
            wrong.append(f"{number}: stale rows: {marker.group(1).strip()}")
        return marker.group(1) + table + marker.group(6)

    for number, line in enumerate(ROWS.sub(made, text).split("\n"), 1):
        line = filled(line, number, wrong, RUN, "word", lambda marker, _: run_of(results / marker.group(1)))
        line = filled(line, number, wrong, WORD, "word", lambda marker, _: word_of(*marker.groups(), results))
        line = filled(line, number, wrong, TEST, "number", lambda m, text: number_of_test(text, *m.groups(), root))
        line = filled(
            line, number, wrong, MARKER, "number", lambda m, text: written_like(text, value_of(*m.groups(), results))
        )
        wrong += [f"{number}: {what}" for what in false_sentences(line, results)]
        lines.append(line)
        rest = line
        for kind in (MARKER, TEST, RUN, WORD, ALL, LESS):
            rest = kind.sub("", rest)
        if "<!-- rows" not in line and re.search(r"<!--.*\.csv|<!--\s*test\s", rest):
            wrong.append(f"{number}: a marker that is not understood: {line.strip()}")
    return "\n".join(lines), wrong


def main(arguments):
    if arguments not in ([], ["--write"]):
        sys.exit(__doc__)
    left = 0
    for path in sorted(path for pattern in DOCUMENTS for path in ROOT.glob(pattern)):
        text = path.read_text(encoding="utf-8")
        new, wrong = checked(text, ROOT / RESULTS)
        if arguments and new != text:
            path.write_text(new, encoding="utf-8")
            _, wrong = checked(new, ROOT / RESULTS)
        for what in wrong:
            print(f"{path.relative_to(ROOT)}:{what}")
        left += len(wrong)
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
