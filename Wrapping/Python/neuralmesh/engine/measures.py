# SPDX-License-Identifier: BSD-3-Clause
"""Measures of given meshes, as of vtkNeuralMeshComparison and vtkNeuralMeshExplanation, without VTK."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _engine
from .._both_ways import BOTH_WAYS
from .._property import Property, new_values, with_properties
from .._types import Progress
from .algorithm import of_name
from .cloud import Cloud
from .mesh import Mesh
from .reconstruction import explained_points

DIRECTIONS = ("reference to result", "result to reference")
_LENGTHS = ("Mean", "RMS", "Percentile99", "Maximum")
_EDGE_LENGTHS = ("EdgeMean", "EdgeToSurface")


class Measure:
    """A class that has properties."""

    PROPERTIES: dict[str, Property]

    def __init__(self) -> None:
        self._values = new_values(type(self))

    def Modified(self) -> None:
        """Called when a property changes. The classes for pipelines have that of VTK."""

    def _warn(self, text: str) -> None:
        """Called with a warning about a property."""


@dataclass
class Comparison:
    """What compares two surfaces."""

    table: dict[str, list[float]]  # columns, of a row for each direction
    both_ways: dict[str, float]
    reference_distances: np.ndarray
    result_distances: np.ndarray
    diagonal: float  # of the reference


@with_properties(
    Property("NumberOfSamples", "count", 200000, 1000, 100000000),
    *of_name("Seed"),
)
class NeuralMeshComparison(Measure):
    """The properties of vtkNeuralMeshComparison, and what it does."""

    def compare(
        self, reference: Mesh, result: Mesh, progress: Progress | None = None
    ) -> Comparison | None:
        """How far two surfaces are from each other; None if progress ended it, or both are empty."""
        if all(len(one.points) == 0 and len(one.triangles) == 0 for one in (reference, result)):
            return None
        figures = _engine.compare(
            *as_arrays(reference),
            *as_arrays(result),
            int(self._values["NumberOfSamples"]),
            int(self._values["Seed"]),
            progress,
        )
        if figures is None:
            return None
        rows = [figures[direction] for direction in DIRECTIONS]
        diagonal = figures["diagonal"]
        table = {name: [row[name] for row in rows] for name in _LENGTHS}
        for name in _LENGTHS:
            table[name + "Percent"] = [100.0 / diagonal * row[name] for row in rows]
        for name in ("NormalAngle", "NormalConsistency", *_EDGE_LENGTHS):
            table[name] = [row[name] for row in rows]
        for name in _EDGE_LENGTHS:
            table[name + "Percent"] = [100.0 / diagonal * row[name] for row in rows]
        table["EdgeLength"] = [row["EdgeLength"] for row in rows]
        both = figures["both ways"]
        for name in ("Chamfer", "Hausdorff", "EdgeChamfer"):
            both[name + "Percent"] = 100.0 / diagonal * both[name]
        return Comparison(
            table,
            {name: both[name] for name in BOTH_WAYS},
            figures["reference distances"],
            figures["result distances"],
            diagonal,
        )


@with_properties(Property("SmallestPiece", "double", 0.0005, 0.0, 1.0))
class NeuralMeshExplanation(Measure):
    """The properties of vtkNeuralMeshExplanation, and what it does."""

    def explain(self, cloud: Cloud, mesh: Mesh, progress: Progress | None = None) -> Mesh | None:
        """The points with their distances and reasons; None if progress ended it."""
        points = [block.points for block in cloud.blocks]
        explained = _engine.explain(
            points, *as_arrays(mesh), float(self._values["SmallestPiece"]), progress
        )
        return None if explained is None else explained_points(cloud, explained)


def report(mesh: Mesh) -> dict[str, Any]:
    """What can be said of a mesh by itself."""
    return _engine.report(*as_arrays(mesh))


def as_arrays(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles as the engine takes them."""
    return (
        np.ascontiguousarray(mesh.points, dtype=np.float64),
        np.ascontiguousarray(mesh.triangles, dtype=np.int64),
    )
