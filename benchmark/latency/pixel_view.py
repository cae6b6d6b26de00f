#!/usr/bin/env python3
"""Scene and view with which scripts/latency measures to the pixel. pixel_view.py FOLDER writes FOLDER/ruler.urdf, a
ruler with stripes of 4 mm in red, green and blue, and FOLDER/pixel.rviz, a view of it from above with 50,000 pixels per
metre."""
import pathlib
import sys

import yaml

STRIPE = 0.004  # [m]; with COLORS and SCALE as in pixel_observer.h
COLORS = ["1 0 0", "0 1 0", "0 0 1"]
SCALE = 50000.0  # [pixels/m]
CENTRE_X = 0.3  # [m]
FIRST, LAST = -56, 4  # stripes: what passes the middle of the picture while the hand goes 0.2 m, and some more


def ruler():
    stripes = "".join(
        '<visual><origin xyz="%g 0 0"/><geometry><box size="%g 0.05 0.01"/></geometry>'
        '<material name="m%d"><color rgba="%s 1"/></material></visual>'
        % ((k + 0.5) * STRIPE, STRIPE, k % 3, COLORS[k % 3])
        for k in range(FIRST, LAST)
    )
    return (
        '<robot name="ruler"><link name="workbench"/><link name="ruler"><inertial><mass value="1"/>'
        '<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>%s</link>'
        '<joint name="free" type="floating"><parent link="workbench"/><child link="ruler"/></joint></robot>' % stripes
    )


def view():
    return {
        "Panels": [],
        "Visualization Manager": {
            "Class": "",
            "Displays": [
                {
                    "Class": "spring_workbench/Objects",
                    "Name": "Objects",
                    "Enabled": True,
                    "Value": True,
                    "Topic": "manipulation/display/objects",
                    "Scene Topic": "manipulation/scene_description",
                }
            ],
            "Enabled": True,
            "Value": True,
            "Global Options": {"Background Color": "38; 42; 48", "Fixed Frame": "world", "Frame Rate": 60},
            "Tools": [{"Class": "rviz/MoveCamera"}],
            "Views": {
                "Current": {
                    "Class": "rviz/TopDownOrtho",
                    "Name": "Current View",
                    "Scale": SCALE,
                    "X": CENTRE_X,
                    "Y": 0,
                    "Angle": 0,
                    "Target Frame": "world",
                }
            },
        },
        "Window Geometry": {"Width": 400, "Height": 300, "X": 0, "Y": 0},
    }


folder = pathlib.Path(sys.argv[1])
(folder / "ruler.urdf").write_text(ruler())
(folder / "pixel.rviz").write_text(yaml.safe_dump(view()))
