#!/usr/bin/env python3
"""A box swings on the spring-fork: its motion, and what accuracy costs with each integrator.

Writes swing.png and work_precision.png. Usage: draw.py [--scene SCENE.urdf] [--out FOLDER]"""
import argparse
import pathlib
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import spring_workbench as sw

HERE = pathlib.Path(__file__).resolve().parent
DOWN = [1.0, 0.0, 0.0, 0.0]  # a quaternion: the fork points down
END = 1.0  # [s]


def simulation_of(scene, integrator, step):
    """Simulation of the box in a hand that moves sideways, back and forth, sampled at 50 Hz."""
    settings = {
        "contact": "none",
        "grasp.object": "box",
        "integrator": integrator,
        "step": step,
        "fork.stiffness": {"stretch": 400.0, "bend": 100.0, "torsion": 1.0},
        "fork.damping": {"stretch": 0.1, "bend": 0.1, "torsion": 0.1},
    }
    simulation = sw.Simulation(scene, settings)
    for t in np.arange(0.0, END + 0.01, 0.02):
        simulation.push_stylus(t, sw.pose([0.05 * (1.0 - np.cos(6.0 * t)), 0.0, 0.23], DOWN))
    return simulation


def draw_swing(scene, path):
    simulation = simulation_of(scene, "exponential", 0.02)
    times = np.arange(0.0, END, 0.01)
    hand, box, bend = [], [], []
    for t in times:
        simulation.advance_to(t)
        fork = simulation.tool()
        hand.append(fork.stylus_pose[0, 3])
        box.append(simulation.poses[0, 0, 3])
        bend.append(np.hypot(*fork.bend))
    figure, (above, below) = plt.subplots(2, 1, sharex=True)
    above.plot(times, hand, label="hand")
    above.plot(times, box, label="box")
    above.set_ylabel("x [m]")
    above.legend()
    below.plot(times, 1e3 * np.array(bend))
    below.set_ylabel("deflection [mm]")
    below.set_xlabel("time [s]")
    figure.savefig(path)


def work_precision(scene):
    """integrator -> rows of step [s], run time [s], error of the box's position at the end [m]."""

    def run(integrator, step):
        least = np.inf  # of three, since other programs only add to a run time
        for _ in range(3):
            simulation = simulation_of(scene, integrator, step)
            started = time.perf_counter()
            simulation.advance_to(END)
            least = min(least, time.perf_counter() - started)
        return least, simulation.poses[0, :3, 3]

    _, reference = run("exponential", 1e-4)
    table = {}
    for integrator in sw.integrators():
        rows = []
        for step in 0.02 / 2.0 ** np.arange(2, 7):
            seconds, position = run(integrator, step)
            rows.append((step, seconds, np.linalg.norm(position - reference)))
        table[integrator] = np.array(rows)
    return table


def draw_work_precision(table, path):
    figure, axes = plt.subplots(figsize=(8.0, 4.8), layout="constrained")
    for integrator, rows in table.items():
        usable = rows[:, 2] < 0.1
        axes.loglog(rows[usable, 1], rows[usable, 2], "o-", label=integrator)
    axes.set_xlabel("run time per simulated second [s]")
    axes.set_ylabel("error of the box's position [m]")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))  # beside the lines
    figure.savefig(path)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--scene", default=str(HERE.parent / "01_lift_a_box/box.urdf"))
    arguments.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    given = arguments.parse_args()
    scene = sw.load_scene(given.scene)
    draw_swing(scene, given.out / "swing.png")
    table = work_precision(scene)
    draw_work_precision(table, given.out / "work_precision.png")
    print("integrator            step [ms]  error [m]")
    for integrator, rows in table.items():
        for step, _, error in rows:
            print(f"{integrator:20}  {1e3 * step:9.4f}  {error:.3e}")


if __name__ == "__main__":
    main()
