#!/usr/bin/python3
"""plot_scene.py PNG [AZIMUTH ELEVATION] < SHAPES: draws the output of `contact_trials show`."""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

BOX = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]


def faces(shape):
    """The polygons of a shape's surface, in world coordinates [m]."""
    points = np.array(shape["points"])
    if shape["kind"] == "box":
        return [points[list(face)] for face in BOX]
    if shape["kind"] == "mesh":
        return [points[triangle] for triangle in shape["triangles"]]
    around = np.linspace(0.0, 2.0 * np.pi, 13)
    if shape["kind"] == "sphere":
        polar = np.linspace(0.0, np.pi, 7)
        grid = points[0] + shape["radius"] * np.array(
            [[[np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)] for b in around] for a in polar]
        )
    else:
        axis = (points[1] - points[0]) / np.linalg.norm(points[1] - points[0])
        x = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[0]) < 0.9 else [0.0, 1.0, 0.0])
        x /= np.linalg.norm(x)
        rim = shape["radius"] * np.array([np.cos(a) * x + np.sin(a) * np.cross(axis, x) for a in around])
        grid = np.array([points[0] + rim, points[1] + rim])
    return [
        np.array([a, b, c, d])
        for low, high in zip(grid, grid[1:])
        for a, b, c, d in zip(low, low[1:], high[1:], high)
    ]


shapes = [json.loads(line) for line in sys.stdin]
azimuth, elevation = (float(a) for a in sys.argv[2:4]) if len(sys.argv) > 3 else (-60.0, 20.0)
figure = plt.figure(figsize=(7, 6))
axes = figure.add_subplot(projection="3d", proj_type="ortho")
corners = np.concatenate([np.concatenate(faces(shape)) for shape in shapes if shape["movable"]])
for shape in shapes:
    color = "#d97b29" if shape["held"] else "#7aa6c2" if shape["movable"] else "#cccccc"
    axes.add_collection3d(
        Poly3DCollection(faces(shape), facecolor=color, edgecolor="#33333380", linewidth=0.3, alpha=0.85)
    )
low, high = corners.min(axis=0), corners.max(axis=0)
middle, half = 0.5 * (low + high), 0.5 * (high - low).max()
axes.set(**{f"{a}lim": (middle[i] - half, middle[i] + half) for i, a in enumerate("xyz")})
axes.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
axes.set_box_aspect((1, 1, 1))
axes.view_init(elev=elevation, azim=azimuth)
figure.tight_layout()
figure.savefig(sys.argv[1], dpi=90)
