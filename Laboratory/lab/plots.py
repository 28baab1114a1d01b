# SPDX-License-Identifier: BSD-3-Clause
"""Plots and pictures, by matplotlib, which is loaded when the first one is drawn."""

from __future__ import annotations

import functools
import importlib.util
import math
from pathlib import Path
from typing import Any, Callable, Sequence

import numpy as np

from ..batch.atomic_file import atomic_file
from .store import read_stored_mesh
from .table import COLUMNS, Table

_COLORS = ("#22539c", "#d1661f", "#2d8a4e", "#9a2a6a", "#7a6a1a", "#555566", "#c02030")
_LIGHT = np.array([0.35, 0.45, 0.82])
_FRONT, _BACK = np.array([0.78, 0.82, 0.92]), np.array([0.42, 0.20, 0.16])


def has_matplotlib() -> bool:
    return importlib.util.find_spec("matplotlib") is not None


@functools.lru_cache(maxsize=None)
def _pyplot() -> Any:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.rcParams.update(
        {
            "axes.grid": True,
            "axes.axisbelow": True,
            "axes.prop_cycle": pyplot.cycler(color=_COLORS),
            "axes.spines.right": False,
            "axes.spines.top": False,
            "font.size": 9,
            "grid.color": "#e4e6ea",
            "legend.frameon": False,
            "savefig.dpi": 110,
        }
    )
    return pyplot


def _save(figure: Any, path: Path) -> None:
    with atomic_file(path) as temporary:
        # No date: the same results give the same bytes.
        figure.savefig(temporary, bbox_inches="tight", metadata={"Software": None})
    _pyplot().close(figure)


def _label(axes: Any, x: str, y: str) -> None:
    for set_label, name in ((axes.set_xlabel, x), (axes.set_ylabel, y)):
        column = COLUMNS.get(name)
        set_label(f"{column.title} [{column.unit}]" if column and column.unit
                  else column.title if column else name)  # fmt: skip


def plain(name: str) -> str:
    """A name of the program in words; what has blanks is in words already."""
    return name if " " in name else name.replace("_", " ")


def _title(factor: str, value: Any) -> str:
    """What a panel shows; on and off say nothing by themselves."""
    return f"{plain(factor)} {value}" if value in ("on", "off") else plain(str(value))


def _legend(figure: Any, axes: Any, factor: str) -> None:
    """Below all panels, where it hides nothing."""
    handles, labels = axes.get_legend_handles_labels()
    figure.tight_layout()
    figure.legend(
        handles,
        [plain(label) for label in labels],
        title=plain(factor),
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        ncol=min(len(labels), 7),
        fontsize=8,
    )


Plot = Callable[[Table, Path], None]


def bars(columns: Sequence[str], factor: str, over: str = "model", log: bool = False) -> Plot:
    """A panel for each column: bars by the factor, in groups, with standard errors."""

    def plot(table: Table, path: Path) -> None:
        size = (4.2 * len(columns), 3.2)
        figure, panels = _pyplot().subplots(1, len(columns), figsize=size, squeeze=False)
        groups, values = table.values(over), table.values(factor)
        width = 0.8 / len(values)
        for axes, column in zip(panels[0], columns):
            for i, value in enumerate(values):
                parts = [table.where(**{over: group, factor: value}) for group in groups]
                places = np.arange(len(groups)) + (i - (len(values) - 1) / 2) * width
                errors = [part.error(column) for part in parts]
                means = [part.mean(column) for part in parts]
                axes.bar(places, means, 0.92 * width, yerr=errors, label=str(value))
            axes.set_xticks(range(len(groups)), [plain(str(group)) for group in groups])
            axes.grid(visible=False, axis="x")
            if log:
                axes.set_yscale("log")
            _label(axes, "", column)
        _legend(figure, panels[0][0], factor)
        _save(figure, path)

    return plot


def lines(columns: Sequence[str], factor: str, over: str = "model") -> Plot:
    """A panel for each column: the mean over a factor that is a number, a line for each group."""

    def plot(table: Table, path: Path) -> None:
        size = (4.2 * len(columns), 3.2)
        figure, panels = _pyplot().subplots(1, len(columns), figsize=size, squeeze=False)
        for axes, column in zip(panels[0], columns):
            for (group,), part in table.groups(over):
                values = [value for value in part.values(factor) if not isinstance(value, str)]
                parts = [part.where(**{factor: value}) for value in values]
                means = [part.mean(column) for part in parts]
                errors = [part.error(column) for part in parts]
                axes.errorbar(values, means, errors, marker="o", markersize=4, label=str(group))
            _label(axes, plain(factor), column)
        _legend(figure, panels[0][0], over)
        _save(figure, path)

    return plot


def curves(
    panels: Sequence[str], factor: str, x: str = "vertices", over: str = "model", log: bool = False
) -> Plot:
    """What was so while meshes grew: a row for each figure, a panel for each model."""

    def plot(table: Table, path: Path) -> None:
        models = table.values(over)
        size = (3.6 * len(models), 2.8 * len(panels))
        figure, grid = _pyplot().subplots(
            len(panels), len(models), figsize=size, squeeze=False, sharey="row"
        )
        for row, column in zip(grid, panels):
            for axes, model in zip(row, models):
                for (value,), part in table.where(**{over: model}).groups(factor):
                    axes.plot(*part.curve(x, column), label=str(value))
                axes.set_title(_title(over, model), fontsize=9)
                if log:
                    axes.set_xscale("log")
                    axes.set_yscale("log")
                _label(axes, x, column if axes is row[0] else "")
        _legend(figure, grid[0][0], factor)
        _save(figure, path)

    return plot


def draw_meshes(meshes: Sequence[tuple[str, str, int]], path: Path) -> None:
    """Meshes side by side, each by its title, its file and the axis that points upwards. Triangles
    seen from behind are dark."""
    figure, panels = _pyplot().subplots(
        1, len(meshes), figsize=(2.9 * len(meshes), 3.1), squeeze=False
    )
    for axes, (title, file, up) in zip(panels[0], meshes):
        _draw_mesh(axes, *read_stored_mesh(file), up)
        axes.set_title(title, fontsize=9)
    _save(figure, path)


def _draw_mesh(axes: Any, points: np.ndarray, triangles: np.ndarray, up: int) -> None:
    """By the painter's algorithm: the triangles farthest from the eye first."""
    from matplotlib.collections import PolyCollection

    corners = (points - points.mean(axis=0)) @ _view(up).T
    corners = corners[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    is_front = normals[:, 2:] > 0
    shade = 0.35 + 0.65 * np.clip(np.abs(normals @ (_LIGHT / np.linalg.norm(_LIGHT))), 0, 1)
    colors = np.where(is_front, _FRONT, _BACK) * shade[:, None]
    order = np.argsort(corners[:, :, 2].mean(axis=1))
    axes.add_collection(
        PolyCollection(
            corners[order][:, :, :2],
            facecolors=colors[order],
            edgecolors="#303540",
            linewidths=0.25,
        )
    )
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()


def _view(up: int) -> np.ndarray:
    """Rows: what is right, up and towards the eye, which is a little aside and above."""
    turn, tilt = math.radians(30), math.radians(30)
    aside = np.array([[math.cos(turn), 0, -math.sin(turn)], [0, 1, 0],
                      [math.sin(turn), 0, math.cos(turn)]])  # fmt: skip
    above = np.array([[1, 0, 0], [0, math.cos(tilt), -math.sin(tilt)],
                      [0, math.sin(tilt), math.cos(tilt)]])  # fmt: skip
    # With y upwards, right is x and depth z; with z upwards, they are y and x.
    return above @ aside @ np.roll(np.eye(3), up - 1, axis=1)
