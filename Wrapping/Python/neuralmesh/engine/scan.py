# SPDX-License-Identifier: BSD-3-Clause
"""The point cloud that a scan of a surface might give, as vtkNeuralMeshScan makes it, without VTK."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _engine
from .._property import Property, with_properties
from .._types import Progress
from .algorithm import of_name, three
from .measures import Measure, as_arrays
from .mesh import Mesh


@with_properties(
    Property("NumberOfPoints", "count", 200000, 1, 100000000),
    *of_name("Seed"),
    Property("Noise", "double", 0.0, 0.0, 1.0),
    Property("Outliers", "double", 0.0, 0.0, 10.0),
    Property("Holes", "int", 0, 0, 1000),
    Property("HoleRadius", "double", 0.03, 0.0, 1.0),
    Property("Occlusion", "bool", 0, 0, 1),
)
class NeuralMeshScan(Measure):
    """The properties of vtkNeuralMeshScan, and what it does."""

    def __init__(self) -> None:
        super().__init__()
        self._viewpoint = (0.0, 0.0, 0.0)

    def SetViewpoint(self, *place: Any) -> None:
        """Where the scanner stands, with Occlusion, in coordinates of the surface."""
        if self._viewpoint != three(place):
            self._viewpoint = three(place)
            self.Modified()

    def GetViewpoint(self) -> tuple[float, float, float]:
        """Three numbers."""
        return self._viewpoint

    def scan(self, surface: Mesh, progress: Progress | None = None) -> Mesh:
        """Points, of the precision of the surface; none if progress ended it. ValueError where there is
        no area, or no finite viewpoint.
        """
        viewpoint = np.array(self._viewpoint)
        if self._values["Occlusion"] and not np.isfinite(viewpoint).all():
            raise ValueError("The viewpoint is not finite.")
        points = _engine.scan(
            *as_arrays(surface),
            self._values,
            viewpoint if self._values["Occlusion"] else None,
            surface.points.dtype == np.float64,
            progress,
        )
        return Mesh(points, np.empty((0, 3), dtype=np.int64))
