#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the rooms of the engine, as they are: draw_house.py FOLDER NAME..."""

import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

CORE = Path(__file__).resolve().parents[2] / "Filters" / "Core"
# Where each room stands, and what lives there.
ROOMS = {
    "base": (0.5, 0.0, "threads, random numbers,\narchives, vectors"),
    "mesh": (0.5, 1.0, "mesh, operations,\nboundaries, repair"),
    "cloud": (0.5, 2.0, "points, samples,\nplaces on the mesh"),
    "file": (1.75, 2.0, "formats of points\nand meshes"),
    "learn": (-0.75, 3.0, "the algorithm:\nNeuralMesh, Learner"),
    "fit": (0.5, 3.0, "least squares,\ngaps, finish"),
    "start": (1.75, 3.0, "the first\nsurface"),
    "run": (0.5, 4.0, "begin, learn, finish, describe:\nwhole runs"),
}
COLOURS = dict(zip(ROOMS, ["#dddddd", "#c8d8ec", "#cfe6cf", "#cfe3e3", "#f6d9b0", "#f3c8c8", "#e0d0ec", "#f4f0b8"]))


def sources(room):
    return [path for path in (CORE / room).iterdir() if path.suffix in {".h", ".cpp", ".in"}]


def included():
    """The other rooms that each one includes."""
    return {
        room: {
            other
            for path in sources(room)
            for other in re.findall(r'#include "([a-z]+)/', path.read_text(encoding="utf-8"))
            if other != room
        }
        for room in ROOMS
    }


def rooms(folder):
    """The rooms, their lines of code, and who includes whom.

    There is no arrow to a room that is reached by way of another one.
    """
    _, axes = plt.subplots(figsize=(7.6, 6.4))
    direct = included()
    for room, others in direct.items():
        for other in others - {further for one in others for further in direct[one]}:
            x, y, _ = ROOMS[room]
            to_x, to_y, _ = ROOMS[other]
            beside = y == to_y
            axes.annotate(
                "",
                xy=(to_x + (0.33 if beside else 0.0), to_y + (0.0 if beside else 0.25)),
                xytext=(x - (0.33 if beside else 0.0), y - (0.0 if beside else 0.25)),
                arrowprops={"arrowstyle": "-|>", "color": "#555555", "linewidth": 1.5},
                zorder=1,
            )
    for room, (x, y, what) in ROOMS.items():
        lines = sum(len(path.read_text(encoding="utf-8").splitlines()) for path in sources(room))
        axes.text(
            x,
            y,
            f"{room}\n{what}\n{len(sources(room))} files, {lines:,} lines",
            ha="center",
            va="center",
            fontsize=8,
            linespacing=1.25,
            bbox={"boxstyle": "round,pad=0.45", "facecolor": COLOURS[room], "edgecolor": "#555555"},
            zorder=2,
        )
    axes.set(xlim=(-1.4, 2.4), ylim=(-0.45, 4.45))
    axes.axis("off")
    plt.tight_layout()
    plt.savefig(Path(folder) / "rooms.png", dpi=130)


def main():
    folder, *names = sys.argv[1:]
    makers = {"rooms": rooms}
    for name in names:
        makers[name](folder)


if __name__ == "__main__":
    main()
