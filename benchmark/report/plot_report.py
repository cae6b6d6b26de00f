#!/usr/bin/env python3
"""Draws the report's pictures from its CSV files, without a display.
Usage: plot_report.py scene    error_table.csv PICTURE.png SCENE HAND    a column per stiffness and
       mass, a row per measure of error
       plot_report.py overview rod_table.csv PICTURE.png contact_drag.csv
                                                                    the default rod, soft and stiff, light and heavy,
                                                                    beside general methods and the best of the
                                                                    engines; contact beside engines
       plot_report.py brief    rod_table.csv PICTURE.png contact_drag.csv
                                                                    the same with fewer lines, named at their ends
       plot_report.py recording recording.csv PICTURE.png           a line per integrator
       plot_report.py rods     rod_table.csv PICTURE.png            a panel per case, a line per integrator
       plot_report.py shapes   elastica.csv PICTURE.png rod_table.csv  error of the model beside that of integration
       plot_report.py tolerance rod_table.csv PICTURE.png           error reached against tolerance asked
       plot_report.py stability stability_map.csv PICTURE.png [contact_limit_cases.csv contact_map.csv]
                                                                    a panel per integrator and contact mode, and one
                                                                    for the map of contact
       plot_report.py contact contact_drag.csv PICTURE.png contact_impact.csv contact_steps.csv"""
import csv
import math
import sys
from collections import defaultdict

try:
    import matplotlib
except ImportError:
    sys.exit("plot_report.py: matplotlib is not there (package python3-matplotlib)")
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

LEAST_ERROR = 1e-13  # smaller ones are drawn here
MEASURES = {
    "error_over_hand_amplitude": "largest error / hand's amplitude",
    "error_over_largest_deflection": "largest error / largest deflection",
}
TIME = "wall_us_per_simulated_second"
TIME_LABEL = "run time [µs per simulated second]"
OURS = ["#d62728", "#1f77b4", "#2ca02c", "#9467bd", "#8c564b", "#e377c2", "#17becf", "#bcbd22"]
BASELINES = ["#ff7f0e", "#7f7f7f", "#2ca02c", "#1f77b4", "#9467bd", "#8c564b", "#17becf", "#bcbd22"]
DEFAULT = "exponential"
PAPER = "paper"
MARKERS = "s^vD<>pPX*hdH8"

def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def in_order(values):
    return list(dict.fromkeys(values))


def by_step(rows):
    """The finite runs with a fixed step or a solver's own tolerance, not those of the tolerance mode."""
    return [row for row in rows if row["finite"] == "1" and not row.get("error_over_tolerance")]


def points(rows, measure):
    return [(float(row[TIME]), max(float(row[measure]), LEAST_ERROR)) for row in rows]


def best(line):
    """The Pareto front of the points of one method in error and run time."""
    return [p for p in line if not any(q[0] < p[0] and q[1] < p[1] for q in line)]


def log_axes(axes, **settings):
    axes.set(xscale="log", yscale="log", **settings)
    axes.grid(alpha=0.3)


def draw_line(axes, line, **style):
    axes.plot([p[0] for p in line], [p[1] for p in line], **style)


def save(figure, picture, legend_from, right=False):
    handles, labels = {}, []
    for axes in legend_from:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            if label not in handles:
                handles[label] = handle
                labels.append(label)
    if right:
        share = 1.0 - 2.9 / figure.get_figwidth()
        figure.tight_layout(rect=(0, 0, share, 1))
        figure.legend(
            [handles[label] for label in labels],
            labels,
            loc="center left",
            bbox_to_anchor=(share, 0.5),
            frameon=False,
            fontsize=9,
        )
    elif labels:
        columns = min(6, len(labels))
        rows = -(-len(labels) // columns)
        space = (0.24 * rows + 0.1) / figure.get_figheight()
        figure.tight_layout(rect=(0, space, 1, 1))
        figure.legend(
            [handles[label] for label in labels], labels, loc="lower center", ncol=columns, fontsize=8.5, frameon=False
        )
    figure.savefig(picture, dpi=110)


def our_names(rows):
    return in_order(row["method"] for row in rows if row["ours"] == "1")


def styles(rows):
    """Line styles: ours bold, baselines thin with open markers."""
    ours = our_names(rows)
    baselines = in_order(row["method"] for row in rows if row["method"] not in ours)
    style = {}
    for i, name in enumerate(ours):
        style[name] = dict(
            color=OURS[i % len(OURS)], linewidth=2.4, marker="o", markersize=4, zorder=3, label=f"{name} (ours)"
        )
    tab20 = pyplot.get_cmap("tab20").colors
    for i, name in enumerate(baselines):
        style[name] = dict(
            color=tab20[i % 20],
            marker=MARKERS[i % len(MARKERS)],
            linestyle=("-", "--")[i // 20],
            linewidth=0.9,
            markersize=3.5,
            zorder=2,
            label=name,
        )
    return style


def scene(table, picture, name, hand):
    rows = [row for row in by_step(read(table)) if row["scene"] == name and row["hand"] == hand]
    if not rows:
        sys.exit(f"plot_report.py: no finite run of scene {name} with the hand by {hand} in {table}")
    style = styles(rows)
    places = sorted({(float(row["mass"]), float(row["stiffness_factor"])) for row in rows})
    figure, panels = pyplot.subplots(
        len(MEASURES),
        len(places),
        figsize=(2.9 + max(6.0, 3.8 * len(places)), 10.0),
        sharex="col",
        sharey="row",
        squeeze=False,
    )
    for line_of_panels, (measure, label) in zip(panels, MEASURES.items()):
        for axes, place in zip(line_of_panels, places):
            here = [row for row in rows if (float(row["mass"]), float(row["stiffness_factor"])) == place]
            for method, look in style.items():
                draw_line(axes, points([r for r in here if r["method"] == method], measure), **look)
            log_axes(axes, ylim=(0.5 * LEAST_ERROR, 10.0))
        line_of_panels[0].set_ylabel(label)
    for axes, (mass, factor) in zip(panels[0], places):
        axes.set_title(f"scene {name}, stiffness × {factor:g}, {mass:g} kg")
    for axes in panels[-1]:
        axes.set_xlabel(TIME_LABEL)
    save(figure, picture, panels[0], right=True)


SOLVERS = "solver_"  # how general methods on our equation of motion are called
ENGINES = "best engine"  # the line of the best of all engines' points


def power_of_ten(value):
    if value < 1e4:
        return f"{value:g}"
    power = math.floor(math.log10(value) + 1e-9)
    first = value / 10.0**power
    return f"$10^{{{power}}}$" if abs(first - 1.0) < 1e-9 else f"${first:g} \\cdot 10^{{{power}}}$"


def load_name(mass):
    return f"{1e3 * mass:g} g" if mass < 1.0 else f"{mass:g} kg"


def rod_lines(rows, name):
    """Fork and load, what the samples leave open, and the lines of the default method, the general ones, the best of
    the engines' and the paper's on a rod under a tracked hand. The paper's method does not solve the equation of
    motion; an upper bound of its error is drawn: its error against its own limit plus that limit's."""
    here = [row for row in rows if row["scene"] == name and row["shape"] == "linear"]
    general = sorted({row["method"] for row in rows if row["method"].startswith(SOLVERS)})
    lines = {
        method: points([row for row in here if row["method"] == method], "error_over_largest_deflection")
        for method in [DEFAULT] + general
    }
    of_engines = [row for row in here if row["ours"] == "0" and not row["method"].startswith(SOLVERS)]
    lines[ENGINES] = best(sorted(points(of_engines, "error_over_largest_deflection")))
    lines[PAPER] = [
        (float(r[TIME]), (float(r["error"]) + float(r["model_error"])) / float(r["largest_deflection"]))
        for r in here
        if r["method"] == PAPER
    ]
    factor, mass = float(here[0]["stiffness_factor"]), float(here[0]["mass"])
    fork = "default fork" if factor == 1.0 else f"{power_of_ten(factor)} times as stiff"
    left = float(here[0]["hand_error"]) / float(here[0]["largest_deflection"])
    return f"{fork}, {load_name(mass)}", left, lines


def rod_panel(axes, rows, name):
    title, left, lines = rod_lines(rows, name)
    draw_line(
        axes, lines[DEFAULT], color=OURS[0], marker="o", linewidth=3, markersize=5, zorder=3, label=f"ours ({DEFAULT})"
    )
    for i, method in enumerate(method for method in lines if method.startswith(SOLVERS)):
        look = dict(color=BASELINES[i % len(BASELINES)], marker=MARKERS[i], linewidth=1.2, markersize=5, zorder=2)
        draw_line(axes, lines[method], label=method[len(SOLVERS) :].replace("_", " "), **look)
    draw_line(axes, lines[ENGINES], color="black", marker="X", linewidth=1.8, markersize=6, zorder=2, label=ENGINES)
    draw_line(axes, lines[PAPER], color="black", marker="*", linewidth=1.2, markersize=6, linestyle=":", label=PAPER)
    if left > 0.0:
        axes.axhline(left, color="#7f7f7f", linestyle="--", linewidth=1.2, label="left open by the samples")
        place = dict(transform=axes.transAxes, color="#5f5f5f", fontsize=9)
        axes.text(0.03, 0.03, f"samples leave {left:.3g}", **place)
    log_axes(axes, title=title, ylim=(1e-11, 10.0))


def drag_line(rows, method, factor, box):
    return [
        (float(r["cpu_us_per_simulated_second"]), max(1e-2 * float(r["lag_error_percent"]), LEAST_ERROR))
        for r in rows
        if r["finite"] == "1"
        and float(r["stiffness_factor"]) == factor
        and r["method"] == method
        and r["box"] == box
    ]


def drag_panel(axes, rows, factor):
    """A box pressed on a plane and dragged, by us (bold) and the engines; dotted if the box cannot turn."""
    ours = ("stop", "dynamic")
    for i, method in enumerate(in_order(row["method"] for row in rows)):
        if method in ours:
            look = dict(color=OURS[0], linewidth=3, markersize=5, marker="o", zorder=3)
        else:
            colour = BASELINES[(i - len(ours)) % len(BASELINES)]
            look = dict(color=colour, linewidth=1.2, markersize=5, marker=MARKERS[i % len(MARKERS)], zorder=2)
        for box in ("turns", "cannot turn"):
            line = drag_line(rows, method, factor, box)
            if box == "turns":
                look["linestyle"] = "--" if method == "dynamic" else "-"
                look["label"] = f"ours ({method})" if method in ours else method.replace("_", " ")
            else:
                look.update(linestyle=":", label=None)
            draw_line(axes, line, **look)
    fork = "bushing" if factor == 1.0 else f"{power_of_ten(factor)} times as stiff"
    log_axes(axes, title=f"{fork}, 5 kg", ylim=(0.5 * LEAST_ERROR, 10.0))


def overview(table, picture, drags):
    """As wide as a page of text, with legible letters."""
    rows, contact_rows = by_step(read(table)), read(drags)
    figure, panels = pyplot.subplots(2, 3, figsize=(11.0, 9.2))
    names = (("soft_light", "stiff_light"), ("soft_heavy", "stiff_heavy"))
    factors = sorted({float(row["stiffness_factor"]) for row in contact_rows})
    for line, of_line, factor in zip(panels, names, (factors[0], factors[-1])):
        for axes, name in zip(line, of_line):
            rod_panel(axes, rows, name)
        drag_panel(line[2], contact_rows, factor)
        line[0].set_ylabel("largest error / largest deflection")
        line[2].set_ylabel("error of the lag / lag")
    panels[1][2].set_visible(len(factors) > 1)
    for axes in panels[1]:
        axes.set_xlabel("µs per simulated second")
    figure.tight_layout(rect=(0, 0.185, 1, 0.955))
    for x, text in ((0.36, "carried by a hand that is tracked at 50 Hz"), (0.85, "pressed on a plane and dragged")):
        figure.text(x, 0.97, text, ha="center", fontsize=12, fontweight="bold")
    for axes, x, columns in ((panels[0][0], 0.33, 3), (panels[0][2], 0.815, 2)):
        place = dict(loc="upper center", bbox_to_anchor=(x, 0.185), ncol=columns, frameon=False, columnspacing=1.0)
        figure.legend(*axes.get_legend_handles_labels(), fontsize=8.8, **place)
    notes = "run time; steps or tolerances become finer along a line; paper: with its model error"
    figure.text(0.33, 0.012, notes, ha="center", fontsize=9.5)
    figure.text(0.815, 0.012, "processor time; dotted: a box that cannot turn", ha="center", fontsize=9.5)
    figure.savefig(picture, dpi=140)


BRIEF = {  # the lines of `brief` that are named: colour, the point that bears the name, and how far from it
    DEFAULT: ("ours", OURS[0], 0, (-40, -15)),
    PAPER: ("paper", "black", -1, (0, 6)),
    "solver_cvode_bdf": ("CVODE", "#9467bd", 0, (2, 6)),
    "solver_radau": ("Radau", "#8c8c00", -1, (6, -5)),
    "solver_rk4": ("RK4", "#e07000", 0, (-28, -16)),
    "solver_implicit_euler": ("Euler", "#1f77b4", 0, (-6, -19)),
    ENGINES: ("engines", "#2ca02c", -1, (4, 4)),
    "stop": ("ours: stop", OURS[0], 0, (-10, -18)),
    "dynamic": ("ours: dynamic", OURS[0], -1, (-62, -26)),
    "ode_erp_cfm": ("ODE", "#8c8c00", 0, (-2, 6)),
    "bullet_spring2": ("Bullet", "#1f77b4", 0, (-16, 7)),
    "mujoco_joints_implicit": ("MuJoCo", "#9467bd", -1, (-12, -15)),
    "dart_joint_springs": ("DART", "#2ca02c", -1, (-2, -14)),
}


def joined(lines):
    """The lines by method; those of all forms of CVODE, and of Radau, are one, of the best of their points."""
    for form in ("solver_cvode_bdf", "solver_radau"):
        family = [method for method in lines if method.startswith(form.replace("_bdf", ""))]
        points = best(sorted(point for method in family for point in lines.pop(method)))
        if points:
            lines[form] = points
    return lines


def brief_panel(axes, lines, **settings):
    """Lines by method: those of BRIEF in colour, with their names, all others in grey."""
    for method, line in lines.items():
        if method not in BRIEF:
            draw_line(axes, line, color="#cccccc", linewidth=1.0, marker=".", markersize=4, zorder=1)
        elif line:
            name, colour, end, shift = BRIEF[method]
            ours = name.startswith("ours")
            look = dict(linewidth=3.5, zorder=3) if ours else dict(linewidth=1.8, zorder=2)
            look.update(color=colour, marker="o", markersize=5, linestyle=":" if method == PAPER else "-")
            draw_line(axes, line, **look)
            place = dict(xytext=shift, textcoords="offset points", annotation_clip=True)
            named = [point for point in line if point[1] < 1.0] or line  # not where it is unstable
            axes.annotate(name, named[end], color=colour, weight="bold" if ours else "normal", fontsize=13, **place)
    log_axes(axes, **settings)


def brief(table, picture, drags):
    """The panels of `overview` in large letters, with contact at one stiffness."""
    rows, contact_rows = by_step(read(table)), read(drags)
    pyplot.rc("font", size=12)
    figure = pyplot.figure(figsize=(12.0, 7.0))
    cells = figure.add_gridspec(2, 3)
    names = ("soft_light", "stiff_light", "soft_heavy", "stiff_heavy")
    for name, cell in zip(names, (cells[0, 0], cells[0, 1], cells[1, 0], cells[1, 1])):
        axes = figure.add_subplot(cell)
        title, left, lines = rod_lines(rows, name)
        brief_panel(axes, joined(lines), title=title, xlim=(30, 1e6), ylim=(1e-12, 100.0))
        axes.axhline(left, color="#5f5f5f", linestyle="--")
        if name.startswith("soft"):
            axes.set_ylabel("largest error / deflection")
    axes = figure.add_subplot(cells[:, 2])
    lines = {
        method: drag_line(contact_rows, method, 1.0, "turns") for method in in_order(r["method"] for r in contact_rows)
    }
    brief_panel(axes, lines, title="dragged over the bench, 5 kg", xlim=(60, 3e5), ylim=(1e-12, 100.0))
    axes.set_ylabel("error of the lag / lag")
    figure.supxlabel("run time [µs per simulated second]")
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


def recording(table, picture):
    rows = read(table)
    figure, axes = pyplot.subplots(figsize=(9.0, 5.0))
    for i, name in enumerate(in_order(row["integrator"] for row in rows)):
        line = [(float(r[TIME]), max(float(r["error"]), LEAST_ERROR)) for r in rows if r["integrator"] == name]
        draw_line(axes, line, color=OURS[i % len(OURS)], marker="o", linewidth=1.8, markersize=4, label=name)
    uncertainty = float(rows[0]["reference_uncertainty"])
    if uncertainty > 0.0:
        axes.axhline(uncertainty, color="#7f7f7f", linestyle=":", label="what the reference is good for")
    log_axes(axes, title="the recording, every setting", xlabel=TIME_LABEL, ylabel="largest error of a position [m]")
    save(figure, picture, [axes], right=True)


def grid(count):
    columns = min(4, count)
    rows = -(-count // columns)
    figure, panels = pyplot.subplots(rows, columns, figsize=(4.0 * columns, 3.9 * rows), squeeze=False)
    flat = [axes for line in panels for axes in line]
    for axes in flat[count:]:
        axes.set_visible(False)
    return figure, flat[:count]


def rods(table, picture):
    rows = [row for row in by_step(read(table)) if row["shape"] in ("linear", "constant")]
    names = in_order(row["scene"] for row in rows)
    style = styles(rows)
    figure, panels = grid(len(names))
    for axes, name in zip(panels, names):
        here = [row for row in rows if row["scene"] == name]
        shape = "linear" if any(row["shape"] == "linear" for row in here) else "constant"
        for method, look in style.items():
            line = points(
                [r for r in here if r["method"] == method and r["shape"] == shape], "error_over_largest_deflection"
            )
            draw_line(axes, line, **look)
        log_axes(axes, title=f"{name}\n({shape})", xlabel=TIME_LABEL, ylim=(1e-12, 10.0))
        axes.set_ylabel("largest error / largest deflection")
    save(figure, picture, panels)


def shapes(table, picture, rod_table):
    static = read(table)
    rows = [r for r in by_step(read(rod_table)) if r["scene"] == "heavy_large_bend" and r["method"] == DEFAULT]
    figure, (model, integration) = pyplot.subplots(1, 2, figsize=(12.0, 4.8))
    for i, shape in enumerate(in_order(row["shape"] for row in static)):
        look = dict(color=OURS[i % len(OURS)], marker="o", markersize=4, linewidth=1.8, label=shape)
        draw_line(
            model, [(float(r["alpha"]), float(r["tip_error_over_L"])) for r in static if r["shape"] == shape], **look
        )
        draw_line(
            integration, points([r for r in rows if r["shape"] == shape], "error_over_largest_deflection"), **look
        )
    log_axes(
        model,
        title="error of the model: tip against the exact elastica",
        xlabel="load P L² / EI",
        ylabel="distance of the tips / L",
    )
    log_axes(
        integration,
        title="error of integration: heavy_large_bend, exponential",
        xlabel=TIME_LABEL,
        ylabel="largest error / largest deflection",
    )
    save(figure, picture, [model])


def tolerance(table, picture):
    rows = [row for row in read(table) if row["finite"] == "1" and row["error_over_tolerance"]]
    if not rows:
        sys.exit(f"plot_report.py: no run to a tolerance in {table}")
    methods = in_order(row["method"] for row in rows)
    figure, panels = grid(len(methods))
    for axes, method in zip(panels, methods):
        here = [
            (float(r["tolerance"]), float(r["tolerance"]) * float(r["error_over_tolerance"]))
            for r in rows
            if r["method"] == method
        ]
        ends = [min(p[0] for p in here), max(p[0] for p in here)]
        axes.fill_between(
            ends,
            [e / 3.0 for e in ends],
            [e * 3.0 for e in ends],
            color="#2ca02c",
            alpha=0.15,
            label="within a factor of 3",
        )
        axes.plot(
            [p[0] for p in here],
            [max(p[1], LEAST_ERROR) for p in here],
            "o",
            color=OURS[0],
            markersize=4,
            alpha=0.6,
            label="a case and shape",
        )
        log_axes(axes, title=method, xlabel="tolerance asked [m]", ylabel="error reached [m]")
    save(figure, picture, panels[:1])


def share_panel(axes, share, columns, lines):
    image = axes.imshow(share, origin="lower", aspect="auto", cmap="RdYlGn", vmin=0.0, vmax=1.0)
    for y, line in enumerate(share):
        for x, value in enumerate(line):
            if value < 1.0:
                axes.text(x, y, f"{math.floor(100.0 * value)}", ha="center", va="center", fontsize=6.5)
    axes.set_xticks(range(len(columns)), [f"{math.log10(k):.0f}" for k in columns])
    axes.set_yticks(range(len(lines)), lines)
    return image


def shares(rows, line_of, column_of):
    """The fraction of cells that pass, by row and column, and the numbers."""
    held, cells, alone = defaultdict(int), defaultdict(int), 0
    for row in rows:
        place = line_of(row), column_of(row)
        held[place] += int(row["passed"])
        cells[place] += int(row.get("cells", 1))
        alone += int(row.get("on_its_own", 0))
    title = f"{sum(held.values())} of {sum(cells.values())} cells hold"
    if "on_its_own" in rows[0]:
        title += f",\n{alone} of them on their own"
    return {place: held[place] / cells[place] for place in cells if cells[place]}, title


def amount(value):
    if value >= 1e6:
        return f"{value / 1e6:.1f} million"
    return f"{value / 1e3:.0f} thousand" if value >= 1e4 else f"{value:.0f}"


def layer_of_counters(axes, rows, stiffnesses, masses, mass_names):
    """Stops and steps by the fallback per hundred steps, by mass and stiffness; a step may be both."""
    counted, steps = defaultdict(float), defaultdict(float)
    for row in rows:
        place = float(row["mass"]), float(row["stiffness_factor"])
        counted[place] += float(row["stops"]) + float(row["steps_fallback"])
        steps[place] += float(row["steps"])
    share = [[counted[m, k] / steps[m, k] if steps[m, k] else math.nan for k in stiffnesses] for m in masses]
    image = axes.imshow(share, origin="lower", aspect="auto", cmap="Reds", vmin=0.0, vmax=0.1)
    for y, line in enumerate(share):
        for x, value in enumerate(line):
            if value > 0.0:
                text = f"{100.0 * value:.0f}" if value >= 0.01 else "<1"
                color = "white" if value > 0.06 else "black"
                axes.text(x, y, text, ha="center", va="center", fontsize=6.5, color=color)
    axes.set_xticks(range(len(stiffnesses)), [f"{math.log10(k):.0f}" for k in stiffnesses])
    axes.set_yticks(range(len(masses)), mass_names)
    total = {name: sum(float(row[name]) for row in rows) for name in ("steps", "stops", "steps_fallback")}
    axes.set_title(
        f"{rows[0]['integrator']}: {amount(total['stops'])} stops,\n"
        f"{amount(total['steps_fallback'])} by fallback, of {amount(total['steps'])}",
        fontsize=10,
    )
    return image


def stability(table, picture, limit_cases=None, contact_map=None):
    """Draws first the cells that pass, then stops and fallbacks, with one panel per integrator; contact is last."""
    rows = read(table)
    shape = rows[0]["shape"]
    rows = [row for row in rows if row["shape"] == shape]
    names = in_order(row["integrator"] for row in rows)
    stiffnesses = sorted({float(row["stiffness_factor"]) for row in rows})
    masses = sorted({float(row["mass"]) for row in rows})
    contact_rows = read(limit_cases) if limit_cases else []
    modes = in_order(row["contact"] for row in contact_rows)
    columns = 3
    lines = -(-len(names) // columns)
    figure = pyplot.figure(figsize=(12.0, 3.4 * (2 * lines + bool(modes))), layout="constrained")
    heights = [lines, lines] + [1] * bool(modes)
    layers = figure.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0]
    mass_names = ["0" if m == 0.0 else f"1e{math.log10(m):.0f}" for m in masses]

    def panels_of(layer, title, lines_of_layer):
        layer.suptitle(title, fontweight="bold")
        return [axes for line in layer.subplots(lines_of_layer, columns, squeeze=False) for axes in line]

    def finish(layer, panels, used, image, label):
        for axes in panels[used:]:
            axes.set_visible(False)
        layer.colorbar(image, ax=panels, label=label, fraction=0.03)

    held = panels_of(layers[0], "cells that hold", lines)
    for axes, name in zip(held, names):
        share, total = shares(
            [row for row in rows if row["integrator"] == name],
            lambda row: float(row["mass"]),
            lambda row: float(row["stiffness_factor"]),
        )
        image = share_panel(
            axes, [[share.get((m, k), math.nan) for k in stiffnesses] for m in masses], stiffnesses, mass_names
        )
        axes.set_title(f"{name}: {total}", fontsize=10)
    finish(layers[0], held, len(names), image, "share that holds (numbers: per cent)")
    counters = panels_of(layers[1], "stops at the end of the rod's range, and steps taken by the fallback rule", lines)
    for axes, name in zip(counters, names):
        of_it = [row for row in rows if row["integrator"] == name]
        image = layer_of_counters(axes, of_it, stiffnesses, masses, mass_names)
    label = "fraction of the steps (numbers: per hundred;\na step may be both; darkest: 10 or more)"
    finish(layers[1], counters, len(names), image, label)
    for panels in (held, counters):
        for axes in panels[::columns]:
            axes.set_ylabel("mass [kg]")
        for axes in panels[-columns:]:
            axes.set_xlabel("stiffness factor, power of ten")
    if modes:
        contact_panels = panels_of(layers[2], "limit cases of contact, and a map of it", 1)
        for axes, mode in zip(contact_panels, modes):
            here = [row for row in contact_rows if row["contact"] == mode]
            forks = sorted({float(row["stiffness"]) for row in here})
            cases_met = in_order(row["limit_case"] for row in here)
            share, total = shares(here, lambda row: row["limit_case"], lambda row: float(row["stiffness"]))
            image = share_panel(
                axes, [[share.get((line, k), math.nan) for k in forks] for line in cases_met], forks, cases_met
            )
            axes.tick_params(axis="y", labelsize=8)
            axes.set_title(f"{mode}: {total}", fontsize=10)
            axes.set_xlabel("stiffness [N/m], power of ten")
        if contact_map:
            axes = contact_panels[len(modes)]
            here = read(contact_map)
            forks = sorted({float(row["stiffness"]) for row in here})
            ratios = sorted({float(row["mass_ratio"]) for row in here})
            share, total = shares(here, lambda row: float(row["mass_ratio"]), lambda row: float(row["stiffness"]))
            image = share_panel(
                axes,
                [[share.get((r, k), math.nan) for k in forks] for r in ratios],
                forks,
                [f"1e{math.log10(r):.0f}" for r in ratios],
            )
            axes.set_title(f"map: {total}", fontsize=10)
            axes.set_ylabel("mass ratio")
            axes.set_xlabel("stiffness [N/m], power of ten")
        finish(layers[2], contact_panels, len(modes) + bool(contact_map), image, "share that holds")
    figure.savefig(picture, dpi=110)


def contact(table, picture, impacts, steps):
    drags = [row for row in read(table) if row["finite"] == "1" and float(row["stiffness_factor"]) == 1.0]
    figure, panels = grid(3)
    names = in_order(row["method"] for row in drags)
    for i, name in enumerate(names):
        ours = name in ("stop", "dynamic")
        for box, dashes in (("turns", "-"), ("cannot turn", ":")):
            line = [
                (float(r["cpu_us_per_simulated_second"]), max(float(r["lag_error_percent"]), 1e-7))
                for r in drags
                if r["method"] == name and r["box"] == box
            ]
            if line:
                draw_line(
                    panels[0],
                    line,
                    label=name + ("" if box == "turns" else ", cannot turn"),
                    linestyle=dashes,
                    color=(OURS if ours else BASELINES)[i % 8],
                    marker="o" if ours else MARKERS[i],
                    linewidth=2.0 if ours else 1.0,
                )
    log_axes(
        panels[0],
        title="drag, 50 to 1000 steps a second",
        xlabel=TIME_LABEL.replace("run time", "processor time"),
        ylabel="error of the lag [%]",
    )
    rows = read(impacts)
    for i, pair in enumerate(in_order(row["pair"] for row in rows)):
        here = [r for r in rows if r["pair"] == pair]
        line = [
            (float(r["cpu_us"]), max(float(r["largest_error_um"]), 1e-3)) for r in here if r["search"] == "bisection"
        ]
        draw_line(panels[1], line, label=pair + ", 2 to 16 levels", color=OURS[i], marker="o")
        toi = [
            (float(r["cpu_us"]), max(float(r["largest_error_um"]), 1e-3)) for r in here if r["search"] != "bisection"
        ]
        draw_line(
            panels[1], toi, label=pair + ", time of impact", color=OURS[i], marker="*", markersize=12, linestyle="none"
        )
    log_axes(
        panels[1], title="pose of first contact", xlabel="processor time of a search [µs]", ylabel="largest error [µm]"
    )
    rows = read(steps)
    for i, scene_name in enumerate(in_order(row["scene"] for row in rows)):
        line = [
            (float(r["cpu_us_per_simulated_second"]), max(float(r["error_mm"]), 1e-7))
            for r in rows
            if r["scene"] == scene_name
        ]
        draw_line(panels[2], line, label=scene_name, color=OURS[i], marker="o")
    log_axes(
        panels[2],
        title="steps of motions in contact",
        xlabel="processor time [µs per simulated second]",
        ylabel="largest error [mm]",
    )
    figure.set_size_inches(13.0, 5.6)
    for axes in panels:
        axes.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.15), ncol=2)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


KINDS = {
    "contact": contact,
    "scene": scene,
    "overview": overview,
    "brief": brief,
    "recording": recording,
    "rods": rods,
    "shapes": shapes,
    "tolerance": tolerance,
    "stability": stability,
}


def main(arguments):
    if len(arguments) < 3 or arguments[0] not in KINDS:
        sys.exit(__doc__)
    KINDS[arguments[0]](*arguments[1:])


main(sys.argv[1:])
