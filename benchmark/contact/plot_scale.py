#!/usr/bin/python3
"""plot_scale.py CSV PNG: draws the output of `contact_trials scale`."""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

with open(sys.argv[1]) as file:
    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
figure, axes = plt.subplots(1, 3, figsize=(11, 3.2))
for axis, (column, label) in zip(
    axes, [("step_us", "step of 20 ms [µs]"), ("start_ms", "start [ms]"), ("memory_MB", "memory [MB]")]
):
    for mode in dict.fromkeys(row["contact"] for row in rows):
        of_mode = [row for row in rows if row["contact"] == mode]
        axis.plot([int(row["objects"]) for row in of_mode], [float(row[column]) for row in of_mode], "o-", label=mode)
    axis.set(xscale="log", xlabel="resting objects", ylabel=label)
    if column == "start_ms":
        axis.set_yscale("log")
    else:
        axis.set_ylim(bottom=0.0)
    axis.grid(alpha=0.3)
axes[0].legend(title="contact")
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
