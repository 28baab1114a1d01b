# SPDX-License-Identifier: BSD-3-Clause
"""Some points of a file that may be larger than the memory, as vtkNeuralMeshFileSampler draws them, without
VTK.
"""

from __future__ import annotations

import os

from .. import _engine
from .._property import Property, with_properties
from .._types import Progress
from .algorithm import of_name
from .cloud import Block
from .measures import Measure
from .reconstruction import block_of_file

_FORMATS = (("ByExtension", "BY_EXTENSION"), ("RawFloat", "RAW_FLOAT"), ("RawDouble", "RAW_DOUBLE"))
_RAW = ("", "float", "double")  # what the numbers are, by the format


@with_properties(
    Property("NumberOfPoints", "count", 1000000, 1, 2**32 - 1),
    Property("Format", "choice", 0, 0, 2, values=_FORMATS),
    Property("HeaderBytes", "count", 0, 0, 2**63 - 1),
    *of_name("Seed"),
)
class NeuralMeshFileSampler(Measure):
    """The properties of vtkNeuralMeshFileSampler, and what it does."""

    def __init__(self) -> None:
        super().__init__()
        self._file_name = ""
        self._file_points = 0
        self._seconds = 0.0

    def SetFileName(self, name: str | os.PathLike[str] | None) -> None:
        """The file: a binary .ply, a .vtp appended raw, or raw coordinates."""
        wanted = os.fspath(name or "")
        if self._file_name != wanted:
            self._file_name = wanted
            self.Modified()

    def GetFileName(self) -> str:
        """Empty if there is none."""
        return self._file_name

    def GetNumberOfFilePoints(self) -> int:
        """How many points the file has; known after the execution."""
        return self._file_points

    def GetDrawingTime(self) -> float:
        """CPU seconds that the last execution took."""
        return self._seconds

    def draw(self, progress: Progress | None = None) -> Block | None:
        """The points with colours and normals; None if progress ended it. ValueError names the file."""
        self._file_points = 0
        if not self._file_name:
            raise ValueError("There is no FileName.")
        drawn = _engine.draw_points(
            self._file_name,
            int(self._values["NumberOfPoints"]),
            int(self._values["Seed"]),
            progress,
            raw=_RAW[int(self._values["Format"])],
            skip=int(self._values["HeaderBytes"]),
        )
        if drawn is None:
            return None
        self._file_points, self._seconds = drawn["file_points"], drawn["seconds"]
        return block_of_file(drawn)
