#!/usr/bin/env python3
"""Run times of each method in other builds, relative to the first: the median over all settings that both have.
Usage: compare_builds.py REPORT_FOLDER NAME=REPORT_FOLDER ... Prints a CSV table."""
import csv
import pathlib
import statistics
import sys
from collections import defaultdict

TIMES = {  # table: column of the run time
    "error_table": "wall_us_per_simulated_second",
    "rod_table": "wall_us_per_simulated_second",
    "contact_drag": "cpu_us_per_simulated_second",
}
SETTING = ["scene", "stiffness_factor", "mass", "shape", "method", "hand", "step", "tolerance", "box"]


def times(folder, table):
    """Run times by setting, each with its method."""
    path = pathlib.Path(folder, table + ".csv")
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {tuple(row.get(key) for key in SETTING): float(row[TIMES[table]]) for row in rows if row["finite"] == "1"}


def main(default, *others):
    names, folders = zip(*(other.split("=") for other in others))
    print(",".join(["table", "method", "settings", *names]))
    for table in TIMES:
        first = times(default, table)
        ratios = defaultdict(lambda: defaultdict(list))  # by method and build
        for name, folder in zip(names, folders):
            for setting, time in times(folder, table).items():
                if first.get(setting):
                    ratios[setting[SETTING.index("method")]][name].append(time / first[setting])
        for method, of_build in ratios.items():
            # A build may share no setting with the first: some lines begin where they become stable.
            medians = [f"{statistics.median(of_build[name]):.3g}" if of_build[name] else "" for name in names]
            print(",".join([table, method, str(min(len(of_build[name]) for name in names)), *medians]))


if __name__ == "__main__":
    main(*sys.argv[1:])
