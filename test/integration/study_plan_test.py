#!/usr/bin/env python3
"""The plan of a study, its records and its questionnaire. Arguments: program assembly_trials, source folder."""
import collections
import itertools
import os
import random
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1:3]
sys.path.insert(0, os.path.join(SOURCE, "scripts"))
import study_plan as sp  # noqa: E402

PLAN = """
scene: scene.urdf
conditions:
  a: {tool: direct}
  b: {tool: spring_fork, dofs: [bend]}
  c: {tool: ray}
practice: 2
trials: 1
"""
RATINGS = dict(zip(sp.SCALES, (10, 20, 30, 40, 50, 90)))


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def file(self, text, name="a.yaml"):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def refused(self, words, function, *arguments):
        with self.assertRaises(sp.StudyError) as caught:
            function(*arguments)
        self.assertEqual(len(str(caught.exception).splitlines()), 1)
        for word in words:
            self.assertIn(word, str(caught.exception))


class Orders(unittest.TestCase):
    def test_each_condition_follows_each_other_equally_often_and_comes_at_each_place_equally_often(self):
        for count in range(2, 13):
            orders = sp.williams(count)
            times = 1 if count % 2 == 0 else 2
            self.assertEqual(len(orders), times * count)
            for order in orders:
                self.assertEqual(sorted(order), list(range(count)))
            follows = collections.Counter(pair for order in orders for pair in zip(order, order[1:]))
            self.assertEqual(follows, {pair: times for pair in itertools.permutations(range(count), 2)})
            places = collections.Counter(place for order in orders for place in enumerate(order))
            self.assertEqual(places, {place: times for place in itertools.product(range(count), repeat=2)})

    def test_successive_participants_use_every_order(self):
        plan = {"conditions": dict.fromkeys("abcd"), "practice": 1, "trials": 2}
        for first in (1, 3, 8):
            orders = set()
            for participant in range(first, first + 4):
                trials = list(sp.steps(plan, participant))
                self.assertEqual(len(trials), 12)
                self.assertEqual([(s["practice"], s["trial"]) for s in trials], 4 * [(1, 1), (0, 1), (0, 2)])
                self.assertEqual([s["order"] for s in trials], [1 + k // 3 for k in range(12)])
                orders.add(tuple(s["condition"] for s in trials[::3]))
            self.assertEqual(len(orders), 4)


class Plans(WithFolder):
    def test_shipped_plan_and_defaults(self):
        plan = sp.load_plan(os.path.join(SOURCE, "config/study.yaml"))
        for field in ("scene", "settings"):
            self.assertTrue(os.path.exists(plan[field]), plan[field])
        plan = sp.load_plan(self.file(PLAN))
        self.assertEqual(plan["scene"], os.path.join(self.folder, "scene.urdf"))
        self.assertEqual((plan["practice"], plan["trials"], plan["weighted"]), (2, 1, False))
        self.assertEqual(plan["conditions"]["a"]["dofs"], ["stretch", "bend", "torsion"])
        self.assertIn("hold the button down", plan["instructions"])
        plan = sp.load_plan(self.file(PLAN + "instructions: Stack the boxes.\n"))
        self.assertEqual(plan["instructions"], "Stack the boxes.")

    def test_bad_plans_are_refused_in_one_line(self):
        for old, new, words in [
            ("practice: 2", "practice: -1", ["practice", "between 0 and 100", "-1"]),
            ("trials: 1", "trials: 1.5", ["trials", "an integer", "1.5"]),
            ("trials: 1", "time_limit: .nan", ["time_limit", "nan"]),
            ("trials: 1", "weighted: perhaps", ["weighted", "perhaps"]),
            ("trials: 1", "instructions: [a]", ["instructions", "ASCII", "['a']"]),
            ("trials: 1", "instructions: Schön", ["instructions", "ASCII", "Schön"]),
            ("trials: 1", "colour: red", ["colour"]),
            ("tool: ray", "tool: tongs", ["c.tool", "spring_fork", "tongs"]),
            ("[bend]", "[twist]", ["b.dofs", "twist"]),
            ("scene: scene.urdf", "", ["missing required key scene: a path"]),
            ("conditions:", "conditions: {}\nx:", ["x"]),
            ("  a:", "  a/b:", ["a/b"]),
            (PLAN, "scene: s\nconditions: {a: {tool: ray}}", ["conditions", "two"]),
            (PLAN, "[", ["YAML"]),
        ]:
            self.refused(["a.yaml", *words], sp.load_plan, self.file(PLAN.replace(old, new)))
        self.refused(["nowhere.yaml"], sp.load_plan, self.folder + "/nowhere.yaml")


class Results(WithFolder):
    def test_columns_are_those_of_assembly_trials(self):
        text = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True).stdout
        self.assertIn(":" + ",".join(sp.KEY + sp.SCORE) + "participant", "".join(text.split()))

    def test_records_continue_where_they_ended(self):
        expected = list(sp.steps(sp.load_plan(self.file(PLAN)), 5))
        path, columns = os.path.join(self.folder, "p.csv"), sp.KEY + ("time_s",)
        for k, step in enumerate(expected):
            records = sp.Records(path, columns, expected)
            self.assertEqual(records.missing, expected[k:])
            records.append({**step, "time_s": k / 8})
        self.assertEqual([row["time_s"] for row in sp.Records(path, columns, expected).rows][-1], "1.0")

    def test_records_of_another_plan_are_refused(self):
        plan = sp.load_plan(self.file(PLAN))
        expected = list(sp.steps(plan, 1))
        path, columns = os.path.join(self.folder, "p.csv"), sp.KEY + ("time_s",)
        sp.Records(path, columns, expected).append({**expected[0], "time_s": 1})
        self.refused(["p.csv:2"], sp.Records, path, columns, list(sp.steps(plan, 2)))
        self.refused(["p.csv:2"], sp.Records, path, columns, [])
        self.refused(["p.csv:1"], sp.Records, path, columns + ("drops",), expected)
        with open(path, "a", encoding="utf-8") as file:
            file.write("1,1,a,2")
        self.refused(["p.csv:3"], sp.Records, path, columns, expected)


class Tlx(WithFolder):
    def test_raw_and_weighted(self):
        row = sp.tlx("x", RATINGS, dict(zip(sp.SCALES, (5, 4, 3, 2, 1, 0))))
        self.assertEqual((row["tlx_raw"], row["tlx_weighted"]), ("40", "%.9g" % (350 / 15)))
        self.assertEqual(set(row) | set(sp.KEY[:3]), set(sp.TLX_COLUMNS))

    def test_every_set_of_choices_gives_weights_and_equal_ratings_give_that_rating(self):
        choose = random.Random(5)
        for _ in range(200):
            rating = choose.randint(0, 100)
            answers = itertools.chain([str(rating)] * 6, (choose.choice("12") for _ in sp.PAIRS))
            row = sp.ask_tlx(True, say=lambda text: None, ask_line=lambda prompt: next(answers))
            self.assertEqual(sum(row["weight_" + scale] for scale in sp.SCALES), 15)
            self.assertEqual((row["tlx_raw"], row["tlx_weighted"]), (str(rating), str(rating)))

    def test_answers_that_cannot_be_used_are_asked_again(self):
        answers, said = iter(["", "101", "-1", "nan", "much", "0", "100", "5", "5", "5", "5"]), []
        row = sp.ask_tlx(False, say=said.append, ask_line=lambda prompt: next(answers))
        self.assertEqual((len(said), row["mental"], row["physical"], row["tlx_weighted"]), (5, 0, 100, ""))
        for message, value in zip(said, ("", "101", "-1", "nan", "much")):
            self.assertTrue(str(message).startswith(f"answer: rating: invalid value '{value}"), message)
            self.assertTrue(str(message).endswith("': expected a number between 0 and 100"), message)

    def test_bad_files_are_refused_in_one_line(self):
        good = "{" + ", ".join(f"{scale}: 50" for scale in sp.SCALES) + "%s}"
        path = self.file("a: " + good % "")
        self.assertEqual(sp.load_tlx(path, ["a"], False)["a"]["tlx_raw"], "50")
        self.refused(["missing required key a.weights: "], sp.load_tlx, path, ["a"], True)
        weights = ", weights: {mental: %d, physical: %d, temporal: 3, performance: 2, effort: 0, frustration: 0}"
        self.refused(
            ["a", "pairwise"], sp.load_tlx, self.file("a: " + good % weights % (5, 5)), ["a"], True
        )  # 0 + 0 < 1
        self.refused(["weights.mental", "6"], sp.load_tlx, self.file("a: " + good % weights % (6, 4)), ["a"], True)
        self.refused(["b"], sp.load_tlx, path, ["a", "b"], False)
        self.refused(["a", "one of b"], sp.load_tlx, path, ["b"], False)
        for bad, words in [("101", ["101"]), (".nan", ["nan"]), ("true", ["True"]), ("high", ["high"])]:
            text = ("a: " + good % "").replace("effort: 50", "effort: " + bad)
            self.refused(["a: effort", "between 0 and 100", *words], sp.load_tlx, self.file(text), ["a"], False)
        text = ("a: " + good % "").replace("effort: 50", "efort: 50")
        self.refused(["efort"], sp.load_tlx, self.file(text), ["a"], False)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
