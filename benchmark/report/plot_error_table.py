#!/usr/bin/env python3
"""Draws one scene of the report's error table: error over the hand's amplitude against run time, one panel per stiffness
factor, one line per method, ours bold. Usage: plot_error_table.py TABLE.csv PICTURE.png SCENE [FACTOR...]"""
import csv
import sys
from collections import defaultdict

try:
    import matplotlib
except ImportError:
    sys.exit("plot_error_table.py: matplotlib is not there (package python3-matplotlib)")
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

OURS = {"exponential": "#d62728", "rk4": "#1f77b4", "closed_form": "#2ca02c", "semi_implicit_euler": "#9467bd"}
FINE_HAND = "_fine_hand"
LEAST_ERROR = 1e-13  # smaller ones are drawn here


def read_lines(path, scene, factors):
    """{factor: {method: [(run time, error), ...]}} of the finite runs of a scene; all its factors where none are given."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    lines = defaultdict(lambda: defaultdict(list))
    for row in rows:
        factor = float(row["stiffness_factor"])
        if row["scene"] != scene or row["finite"] != "1" or (factors and factor not in factors):
            continue
        point = (float(row["wall_us_per_simulated_second"]), max(float(row["error_over_hand_amplitude"]), LEAST_ERROR))
        lines[factor][row["method"]].append(point)
    return lines


def peer_styles(methods):
    colours = pyplot.get_cmap("tab20").colors
    markers = "os^vD<>pPX*hd"
    return {
        method: {"color": colours[i % len(colours)], "marker": markers[i % len(markers)]}
        for i, method in enumerate(methods)
    }


def style(method, peers):
    if method in peers:
        return dict(peers[method], linewidth=0.8, markersize=3, alpha=0.9, zorder=2)
    name = method[: -len(FINE_HAND)] if method.endswith(FINE_HAND) else method
    dashes = "-" if method.endswith(FINE_HAND) else ":"
    return {"color": OURS.get(name, "black"), "linestyle": dashes, "linewidth": 2.6, "marker": "o", "markersize": 4,
            "zorder": 3}


def label(method, peers):
    if method in peers:
        return method
    return "$\\bf{" + method.replace("_", "\\_") + "}$"


def draw(lines, scene, picture):
    methods = list(dict.fromkeys(method for panel in lines.values() for method in panel))
    ours = [m for m in methods if m in OURS or m.endswith(FINE_HAND)]
    peers = peer_styles([m for m in methods if m not in ours])
    figure, panels = pyplot.subplots(1, len(lines), sharey=True, figsize=(max(8.4, 4.2 * len(lines)), 6.8), squeeze=False)
    for axes, factor in zip(panels[0], sorted(lines)):
        for method in ours + list(peers):
            points = lines[factor].get(method, [])
            axes.plot([p[0] for p in points], [p[1] for p in points], label=label(method, peers), **style(method, peers))
        axes.set(xscale="log", yscale="log", ylim=(0.5 * LEAST_ERROR, 10.0), title=f"scene {scene}, stiffness × {factor:g}",
                 xlabel="run time [µs per simulated second]")
        axes.grid(alpha=0.3)
    panels[0][0].set_ylabel("largest error / hand's amplitude")
    handles, labels = panels[0][0].get_legend_handles_labels()
    columns = max(3, 2 * len(lines))
    rows = -(-len(labels) // columns)
    figure.tight_layout(rect=(0, 0.03 * rows + 0.01, 1, 1))
    figure.legend(handles, labels, loc="lower center", ncol=columns, fontsize=7.5)
    figure.savefig(picture, dpi=110)


def main(arguments):
    if len(arguments) < 3:
        sys.exit(__doc__)
    table, picture, scene = arguments[:3]
    lines = read_lines(table, scene, {float(factor) for factor in arguments[3:]})
    if not lines:
        sys.exit(f"plot_error_table.py: no finite run of scene {scene} in {table}")
    draw(lines, scene, picture)


main(sys.argv[1:])
