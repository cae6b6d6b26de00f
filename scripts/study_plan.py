"""Parts of a study of tools: its plan, the order of the conditions, the records and the questionnaire.
Needs no ROS; scripts/study runs it."""
import csv
import io
import itertools
import os
import re

import yaml

KEY = ("participant", "order", "condition", "trial", "practice")  # of a record: which trial it is
SCORE = (  # as `assembly_trials` and the field csv of ~task have it
    "placed",
    "targets",
    "time_s",
    "hand_path_m",
    "object_path_m",
    "grasps",
    "collisions",
    "drops",
    "broken",
    "largest_force_N",
    "position_error_m",
    "angle_error_rad",
)
TOOLS = ("spring_fork", "spring", "direct", "ray")  # those that hold objects
DOFS = ("stretch", "bend", "torsion")
# NASA-TLX (Hart & Staveland 1988): the ends of each scale are 0 and 100.
SCALES = {
    "mental": "Mental demand: thinking, deciding, remembering, searching (0 very low, 100 very high)",
    "physical": "Physical demand: moving, holding, pressing (0 very low, 100 very high)",
    "temporal": "Temporal demand: pressure of time (0 very low, 100 very high)",
    "performance": "Performance: success in doing the task (0 perfect, 100 failure)",
    "effort": "Effort: how hard the work was, mentally and physically (0 very low, 100 very high)",
    "frustration": "Frustration: insecure, discouraged, annoyed, stressed (0 very low, 100 very high)",
}
PAIRS = tuple(itertools.combinations(SCALES, 2))
INSTRUCTIONS = (
    "Bring each object to its translucent target. With the tip in an object, hold the button down to carry it; "
    "let the button go to put it down."
)


class StudyError(ValueError):
    """Invalid input: one line that says what it is and what is allowed."""


def refuse(where, field, allowed, value):
    if value is None:
        raise StudyError(f"{where}: missing required key {field}: {allowed}")
    raise StudyError(f"{where}: {field}: invalid value '{value}': expected {allowed}")


def number(where, field, value, low, high, kind=(int, float)):
    if isinstance(value, bool) or not isinstance(value, kind) or not low <= value <= high:
        refuse(where, field, f"{'an integer' if kind is int else 'a number'} between {low} and {high}", value)
    return value


def load_yaml(path):
    try:
        with open(path, encoding="utf-8") as file:
            content = yaml.safe_load(file)
    except (OSError, yaml.YAMLError) as error:
        raise StudyError(f"{path}: cannot be read as YAML: {' '.join(str(error).split())}")
    if not isinstance(content, dict):
        raise StudyError(f"{path}: expected a YAML mapping, got {content}")
    return content


def keys_of(where, field, value, allowed):
    """Checks that a mapping has only allowed keys."""
    if not isinstance(value, dict):
        refuse(where, field, "a mapping", value)
    for key in value:
        if key not in allowed:
            refuse(where, f"{field}: key" if field else "key", "one of " + ", ".join(allowed), key)
    return value


def load_plan(path):
    """Reads a plan (doc/reference.md) and fills in all fields. Paths are relative to the plan's folder."""
    defaults = {"settings": None, "practice": 1, "trials": 3, "time_limit": 300.0, "weighted": False}
    defaults["instructions"] = INSTRUCTIONS
    plan = {**defaults, **keys_of(path, "", load_yaml(path), ("scene", "conditions", *defaults))}
    folder = os.path.dirname(os.path.abspath(path))
    for field in ("scene", "settings"):
        if field == "settings" and plan[field] is None:
            continue
        if not isinstance(plan.get(field), str):
            refuse(path, field, "a path", plan.get(field))
        if not plan[field].startswith("package://"):
            plan[field] = os.path.join(folder, plan[field])
    number(path, "practice", plan["practice"], 0, 100, int)
    number(path, "trials", plan["trials"], 1, 100, int)
    number(path, "time_limit", plan["time_limit"], 1, 3600)
    if not isinstance(plan["weighted"], bool):
        refuse(path, "weighted", "true or false", plan["weighted"])
    text = plan["instructions"]
    if not isinstance(text, str) or not text.isascii():  # rviz draws no other characters
        refuse(path, "instructions", "a text of ASCII characters", text)
    conditions = plan.get("conditions")
    if not isinstance(conditions, dict) or len(conditions) < 2:
        refuse(path, "conditions", "a mapping with two entries or more", conditions)
    for label, condition in conditions.items():
        if not isinstance(label, str) or not re.fullmatch(r"\w+", label):
            refuse(path, "conditions: name", "letters, digits and _", label)
        keys_of(path, label, condition, ("tool", "dofs"))
        if condition.get("tool") not in TOOLS:
            refuse(path, f"{label}.tool", "one of " + ", ".join(TOOLS), condition.get("tool"))
        dofs = condition.setdefault("dofs", list(DOFS))
        if not isinstance(dofs, list) or any(dof not in DOFS for dof in dofs):
            refuse(path, f"{label}.dofs", "a list of " + ", ".join(DOFS), dofs)
    return plan


def williams(count):
    """Orders of 0 ... count - 1 (Williams 1949): over all of them each condition is at each position equally often, and
    follows each other one equally often. `count` orders for an even number, twice as many for an odd one."""
    first = [0] + [(k + 1) // 2 if k % 2 else count - k // 2 for k in range(1, count)]
    square = [[(start + k) % count for k in first] for start in range(count)]
    return square if count % 2 == 0 else square + [order[::-1] for order in square]


def steps(plan, participant):
    """The trials of a participant (1, 2, ...), in their order, as keys of their records."""
    labels = list(plan["conditions"])
    orders = williams(len(labels))
    for place, condition in enumerate(orders[(participant - 1) % len(orders)], 1):
        for practice, count in ((1, plan["practice"]), (0, plan["trials"])):
            for trial in range(1, count + 1):
                yield dict(zip(KEY, (participant, place, labels[condition], trial, practice)))


class Records:
    """A CSV file that is complete at every moment and can be continued."""

    def __init__(self, path, columns, expected):
        """`expected`: the keys of all records, in order; the records in the file must be the first ones."""
        self.path, self.columns, self.expected, self.rows = path, columns, list(expected), []
        if not os.path.exists(path):
            return
        with open(path, encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file)
            if reader.fieldnames != list(columns):
                raise StudyError(f"{path}:1: expected the columns {','.join(columns)}; give another --out")
            self.rows = list(reader)
        for line, row in enumerate(self.rows, 2):
            want = [str(value) for key in self.expected[line - 2 : line - 1] for value in key.values()]
            if not want or None in row or None in row.values() or list(row.values())[: len(want)] != want:
                raise StudyError(
                    f"{path}:{line}: invalid value '{','.join(map(str, row.values()))}': expected a line that begins "
                    f"with {','.join(want) or 'nothing'}; give another --out if the plan has changed"
                )

    @property
    def missing(self):
        return self.expected[len(self.rows) :]

    def append(self, row):
        self.rows.append({name: row[name] for name in self.columns})
        text = io.StringIO()
        writer = csv.DictWriter(text, self.columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.rows)
        with open(self.path + ".new", "w", encoding="utf-8") as file:
            file.write(text.getvalue())
            file.flush()
            os.fsync(file.fileno())
        os.replace(self.path + ".new", self.path)


TLX_COLUMNS = KEY[:3] + tuple(SCALES) + tuple("weight_" + scale for scale in SCALES) + ("tlx_raw", "tlx_weighted")


def tlx(where, ratings, weights=None):
    """The columns of a questionnaire. `ratings`: 0 ... 100 of each scale; `weights`: how often each scale was chosen in
    the fifteen pairs, or nothing."""
    keys_of(where, "", ratings, tuple(SCALES))
    for scale in SCALES:
        number(where, scale, ratings.get(scale), 0, 100)
    row = {scale: ratings[scale] for scale in SCALES}
    row.update({"weight_" + scale: "" for scale in SCALES}, tlx_raw=f"{sum(row.values()) / 6:.9g}", tlx_weighted="")
    if weights is None:
        return row
    keys_of(where, "weights", weights, tuple(SCALES))
    for scale in SCALES:
        number(where, "weights." + scale, weights.get(scale), 0, 5, int)
    # Fifteen choices can end like this if and only if any k scales have at least the k (k - 1) / 2 among themselves.
    sums = list(itertools.accumulate(sorted(weights.values())))
    if sums[-1] != len(PAIRS) or any(total < k * (k + 1) // 2 for k, total in enumerate(sums)):
        refuse(where, "weights", "counts of the fifteen pairwise choices", weights)
    row.update({"weight_" + scale: weights[scale] for scale in SCALES})
    row["tlx_weighted"] = f"{sum(weights[scale] * ratings[scale] for scale in SCALES) / len(PAIRS):.9g}"
    return row


def load_tlx(path, conditions, weighted):
    """The questionnaires of an unattended run: the six scales of each condition, with `weights` if it is weighted."""
    content = keys_of(path, "", load_yaml(path), tuple(conditions))
    rows = {}
    for label in conditions:
        if not isinstance(content.get(label), dict):
            refuse(path, label, "a mapping of the six scales", content.get(label))
        ratings = dict(content[label])
        weights = ratings.pop("weights", None)
        if weighted and weights is None:
            refuse(path, label + ".weights", "counts of the fifteen pairwise choices", None)
        rows[label] = tlx(f"{path}: {label}", ratings, weights)
    return rows


def ask(prompt, read, say=print, ask_line=input):
    """Asks until the answer is valid."""
    while True:
        try:
            return read(ask_line(prompt).strip())
        except StudyError as error:
            say(error)


def ask_tlx(weighted, say=print, ask_line=input):
    """The questionnaire at the terminal."""

    def rating(answer):
        try:
            value = float(answer)
        except ValueError:
            value = answer
        return number("answer", "rating", value, 0, 100)

    def choice(answer):
        if answer not in ("1", "2"):
            refuse("answer", "choice", "1 or 2", answer)
        return int(answer) - 1

    ratings = {scale: ask(text + ": ", rating, say, ask_line) for scale, text in SCALES.items()}
    if not weighted:
        return tlx("answers", ratings)
    weights = dict.fromkeys(SCALES, 0)
    say("Which one contributed more to the load of the task?")
    for pair in PAIRS:
        weights[pair[ask(f"1 {pair[0]}, 2 {pair[1]}: ", choice, say, ask_line)]] += 1
    return tlx("answers", ratings, weights)
