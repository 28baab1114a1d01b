# SPDX-License-Identifier: BSD-3-Clause
"""Tables of results: what an experiment is judged by and plotted from."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from typing import Any, Iterator

import numpy as np


@dataclass(frozen=True)
class Column:
    """How a figure is called and written."""

    title: str
    unit: str
    digits: int

    def text(self, value: float, with_unit: bool = True) -> str:
        unit = f" {self.unit}" if with_unit and self.unit else ""
        return f"{value:.{self.digits}f}{unit}"


COLUMNS = {
    "vertices": Column("vertices", "", 0),
    "seconds": Column("CPU time of learning", "s", 2),
    "cost": Column("cost", "µs", 2),
    "regular": Column("regular vertices", "%", 1),
    "valence_deviation": Column("deviation of valences from regular", "", 2),
    "hausdorff": Column("Hausdorff distance", "% of the diagonal", 2),
    "missing": Column("farthest missed", "% of the diagonal", 2),
    "excess": Column("farthest off", "% of the diagonal", 2),
    "rms": Column("RMS distance", "% of the diagonal", 3),
    "normal_angle": Column("angle between normals", "degrees", 1),
    "folds": Column("folded edges", "% of the vertices", 2),
    "inverted": Column("inside out", "% of the area", 1),
    "genus": Column("genus", "", 1),
    "pieces": Column("pieces", "", 1),
    "openings": Column("boundaries", "", 1),
    "largest_triangle": Column("largest triangle", "mean areas", 1),
    "edge_density": Column("density at edges over that of points", "", 2),
    "illegal": Column("splits and collapses refused", "", 0),
    "basic_us": Column("Basic Step, a call", "µs", 2),
    "addition_us": Column("Node Addition, a call", "µs", 2),
    "removal_us": Column("Node Removal, a vertex removed", "µs", 2),
    "basic_seconds": Column("Basic Step", "CPU s", 3),
    "addition_seconds": Column("Node Addition", "CPU s", 3),
    "removal_seconds": Column("Node Removal", "CPU s", 3),
    "topology_seconds": Column("topology learning", "CPU s", 3),
    "topology_us": Column("topology learning, a call", "µs", 0),
}


class Table:
    """Rows of factors and figures, and with each, for curves, the moments of its run."""

    def __init__(self, rows: list[dict[str, Any]]):
        self.rows = rows

    def __len__(self) -> int:
        return len(self.rows)

    def where(self, **factors: Any) -> Table:
        return Table([r for r in self.rows if all(r.get(n) == v for n, v in factors.items())])

    def values(self, name: str) -> list[Any]:
        """Those that a factor takes, in the order of the rows."""
        return list(dict.fromkeys(row[name] for row in self.rows if name in row))

    def groups(self, *names: str) -> Iterator[tuple[tuple[Any, ...], Table]]:
        """The parts that agree in all of the factors, and in what."""
        keys = dict.fromkeys(tuple(row.get(name) for name in names) for row in self.rows)
        for key in keys:
            yield key, self.where(**dict(zip(names, key)))

    def figures(self, name: str) -> np.ndarray:
        """All that there are; what was not measured is not among them."""
        values = (row.get(name) for row in self.rows)
        return np.array([value for value in values if value is not None], float)

    def mean(self, name: str) -> float:
        figures = self.figures(name)
        return float(figures.mean()) if len(figures) else float("nan")

    def error(self, name: str) -> float:
        """The standard error of the mean; 0 of a single figure, of which nothing is known."""
        figures = self.figures(name)
        return float(figures.std(ddof=1) / np.sqrt(len(figures))) if len(figures) > 1 else 0.0

    def curve(self, x: str, y: str) -> tuple[np.ndarray, np.ndarray]:
        """The mean over the rows of a curve against another, where all rows have it."""
        curves = [(np.array(row["curve"][x], float), np.array(row["curve"][y], float))
                  for row in self.rows]  # fmt: skip
        first = max(xs[0] for xs, _ in curves)
        last = min(xs[-1] for xs, _ in curves)
        grid = np.geomspace(first, last, 40)
        return grid, np.mean([np.interp(grid, xs, ys) for xs, ys in curves], axis=0)

    def as_csv(self) -> str:
        """A line for each row; curves become lines of their own, with the moment in front."""
        lines = [line for row in self.rows for line in _lines(row)]
        names = list(dict.fromkeys(name for line in lines for name in line))
        text = io.StringIO()
        writer = csv.DictWriter(text, names, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(lines)
        return text.getvalue()


def _lines(row: dict[str, Any]) -> Iterator[dict[str, Any]]:
    plain = {name: value for name, value in row.items() if name not in ("curve", "mesh_file")}
    curve = row.get("curve") or {}
    moments = [dict(zip(curve, moment)) for moment in zip(*curve.values())]
    for moment in moments:
        yield {**plain, "moment": "growing", **moment}
    yield {**plain, "moment": "end"}
