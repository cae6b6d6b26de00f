#!/usr/bin/env python3
"""The analysis of a study on synthetic numbers with known distributions: real effects are found, and false ones at the
nominal rate. Arguments: source folder."""
import csv
import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from scipy import stats

SOURCE = sys.argv[1]
PROGRAM = os.path.join(SOURCE, "scripts/study_analysis")
sys.path.insert(0, os.path.join(SOURCE, "scripts"))
sys.dont_write_bytecode = True
LOADER = importlib.machinery.SourceFileLoader("study_analysis", PROGRAM)
sa = importlib.util.module_from_spec(importlib.util.spec_from_loader("study_analysis", LOADER))
LOADER.exec_module(sa)


def times(random, effect, participants=12):
    """Times [s] of participants who differ, in four conditions; the last one takes `effect` times as long."""
    own = random.normal(0.0, 0.5, (participants, 1))
    table = np.exp(4.0 + own + random.normal(0.0, 0.2, (participants, 4)))
    table[:, 3] *= effect
    return table


def most(count, rate):
    """Bound that is exceeded by chance once in 10,000 cases."""
    return stats.binom.isf(1e-4, count, rate)


class Statistics(unittest.TestCase):
    def test_a_difference_is_found_and_between_its_conditions(self):
        random, found, elsewhere = np.random.default_rng(1), 0, 0
        for _ in range(40):
            table = times(random, effect=2.0)
            pairs = sa.pairs_of(table)
            found += sa.friedman(table) < 0.05 and all(p < 0.05 for i, j, _, p in pairs if j == 3)
            elsewhere += any(p < 0.05 for i, j, _, p in pairs if j != 3)
            low, high = sa.interval(table[:, 3] / table[:, 0])
            self.assertTrue(1.3 < low < high < 3.0)
        self.assertGreaterEqual(found, 38)
        self.assertLessEqual(elsewhere, most(40, 0.05))

    def test_no_difference_is_found_at_the_nominal_rate(self):
        random, count = np.random.default_rng(2), 2000
        rejected = sum(sa.friedman(times(random, 1.0)) < 0.05 for _ in range(count))
        self.assertLessEqual(rejected, most(count, 0.05))
        self.assertGreaterEqual(rejected, 0.03 * count)  # not by never rejecting

    def test_the_pairs_of_no_difference_are_found_at_the_nominal_rate(self):
        random, count = np.random.default_rng(3), 400
        pairs = [sa.pairs_of(times(random, 1.0, participants=8)) for _ in range(count)]
        self.assertLessEqual(sum(any(p < 0.05 for *_, p in of_one) for of_one in pairs), most(count, 0.05))
        single = sum(of_one[0][2] < 0.05 for of_one in pairs)
        self.assertLessEqual(single, most(count, 0.05))
        self.assertGreaterEqual(single, 0.02 * count)  # exactly 10 of 256 sign changes have p < 0.05: 3.9 %

    def test_the_interval_has_the_median_at_the_nominal_rate(self):
        random, count = np.random.default_rng(4), 400
        inside = 0
        for _ in range(count):
            low, high = sa.interval(random.lognormal(0.0, 1.0, 20))
            inside += low <= 1.0 <= high
        self.assertGreaterEqual(inside, 0.91 * count)
        self.assertLessEqual(inside, 0.98 * count)

    def test_wilcoxon_is_exact_and_ties_and_zeros_do_not_spoil_it(self):
        random = np.random.default_rng(5)
        for count in (5, 9, 12):
            differences = random.normal(0.5, 1.0, count)
            self.assertAlmostEqual(sa.wilcoxon(differences), stats.wilcoxon(differences, mode="exact").pvalue)
            self.assertEqual(sa.wilcoxon(np.append(differences, 0.0)), sa.wilcoxon(differences))
            self.assertAlmostEqual(sa.wilcoxon(-differences), sa.wilcoxon(differences))
        self.assertAlmostEqual(sa.wilcoxon(np.ones(6)), 2.0 / 2**6)  # tied: one of all sign changes on each side
        self.assertEqual(sa.wilcoxon(np.zeros(6)), 1.0)
        for differ in (1, 2, 3):  # of six participants
            self.assertAlmostEqual(sa.wilcoxon(np.repeat([2.5, 0.0], [differ, 6 - differ])), 2.0 / 2**differ)
        self.assertEqual(sa.friedman(np.ones((6, 3))), 1.0)

    def test_holm(self):
        np.testing.assert_allclose(sa.holm([0.01, 0.04, 0.03, 0.005]), [0.03, 0.06, 0.06, 0.02])
        random = np.random.default_rng(6)
        for _ in range(100):
            p = random.uniform(size=random.integers(1, 9)) ** 3
            corrected = sa.holm(p)
            self.assertTrue(np.all(corrected >= p) and np.all(corrected <= np.minimum(1.0, len(p) * p)))
            self.assertTrue(np.all(np.diff(corrected[np.argsort(p)]) >= 0.0))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, columns, rows):
        with open(self.path(name), "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, columns, restval=0)
            writer.writeheader()
            writer.writerows(rows)
        return self.path(name)

    def study(self, table):
        """Three trials that count and one that does not, much longer, per participant and condition."""
        for who, row in enumerate(table, 1):
            key = [{"participant": who, "order": k + 1, "condition": "abcd"[k]} for k in range(4)]
            trials = [
                {**of, "trial": trial, "practice": practice, "time_s": value * factor}
                for of, value in zip(key, row)
                for trial, practice, factor in [(1, 1, 100.0), (1, 0, 1.0), (2, 0, 0.9), (3, 0, 7.0)]
            ]
            yield self.write(f"{who}.csv", sa.KEY + sa.SCORE, trials)
            ratings = [{**of, "tlx_raw": value / 10.0, "tlx_weighted": ""} for of, value in zip(key, row)]
            yield self.write(f"{who}_tlx.csv", sa.TLX_COLUMNS, ratings)

    def run_it(self, *files):
        command = [sys.executable, PROGRAM, *files, "--out", self.path("out")]
        return subprocess.run(command, capture_output=True, text=True)

    def test_report_of_files(self):
        table = times(np.random.default_rng(7), 2.0)
        done = self.run_it(*self.study(table))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(self.path("out/analysis.md"), encoding="utf-8") as file:
            self.assertEqual(file.read() + "\n", done.stdout)
        with open(self.path("out/analysis.png"), "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")
        times_part, tlx_part = done.stdout.split("## time [s]")[1].split("## raw NASA-TLX")
        for k, name in enumerate("abcd"):
            self.assertIn("| %s | %.4g (" % (name, np.median(table[:, k])), times_part)
            self.assertIn("| %s | %.4g (" % (name, np.median(table[:, k]) / 10.0), tlx_part)
        with open(self.path("out/medians.csv"), encoding="utf-8", newline="") as file:
            medians = {(row["measure"], row["condition"]): row["median (95 %)"] for row in csv.DictReader(file)}
        self.assertEqual(sum(measure in ("time_s", "tlx_raw") for measure, _ in medians), 8)
        for (measure, name), text in medians.items():
            self.assertIn(f"| {name} | {text} |", tlx_part if measure == "tlx_raw" else times_part)
        with open(self.path("out/pairs.csv"), encoding="utf-8", newline="") as file:
            for row in csv.reader(file):
                self.assertIn(f"| {' | '.join(row[1:])} |", times_part if row[0] != "tlx_raw" else tlx_part)
        self.assertNotIn("weighted", done.stdout)
        self.assertIn("below 0.0029", done.stdout)  # 6 pairs, 2 of 4096 sign changes

    def test_participants_without_a_condition_are_excluded_by_name(self):
        files = list(self.study(times(np.random.default_rng(8), 1.0, participants=4)))
        with open(files[4], encoding="utf-8") as file:
            lines = file.readlines()
        with open(files[4], "w", encoding="utf-8") as file:
            file.writelines(lines[:-3])  # participant 3 broke off in d
        done = self.run_it(*files)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("time [s]: excluded, since a condition is missing: participants 3.", done.stdout)
        self.assertIn("3 participants.", done.stdout.split("## raw")[0].split("## time")[1])

    def test_bad_files_are_refused_in_one_line(self):
        columns = sa.KEY + sa.SCORE
        row = {"participant": 1, "order": 1, "condition": "a", "trial": 1, "practice": 0, "time_s": 5}
        for rows, words in [
            ([row], ["conditions: expected two or more in the files, got 1"]),
            ([row, row], [":3", "twice"]),
            ([{**row, "time_s": "nan"}], [":2: time_s", "finite", "nan"]),
            ([{**row, "time_s": "long"}], [":2: time_s", "long"]),
            ([row, {**row, "condition": "b"}], ["expected two participants or more with all conditions, got 1"]),
        ]:
            self.refused(self.run_it(self.write("bad.csv", columns, rows)), words)
        self.refused(self.run_it(self.write("bad.csv", ("tool", "seed"), [])), ["bad.csv:1", "columns"])
        self.refused(self.run_it(self.path("nowhere.csv")), ["nowhere.csv"])

    def refused(self, done, words):
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
