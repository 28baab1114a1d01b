# SPDX-License-Identifier: BSD-3-Clause
"""A mesh that is learnt while points arrive, as vtkNeuralMeshStream does it, without VTK."""

from __future__ import annotations

from typing import Any

from .. import _engine
from .._property import Property, with_properties
from .._types import Progress
from .algorithm import NeuralMeshAlgorithm, of_name
from .cloud import Cloud
from .mesh import Mesh


@with_properties(
    *of_name("NumberOfVertices", "Seed"),
    Property("ReservoirSize", "count", 500000, 100, 2**32 - 1, engine=False),
    Property("FinishOutput", "bool", 1, 0, 1, engine=False),
)
class NeuralMeshStream(NeuralMeshAlgorithm):
    """The properties of vtkNeuralMeshStream, and its calls."""

    def __init__(self) -> None:
        super().__init__()
        self._stream: Any = None

    def prepare(self) -> Any:
        """The stream of the engine, made with the properties as they are at first. ValueError if they
        do not go together.
        """
        if self._stream is not None:
            return self._stream
        problems = self.parameter_errors()
        error = _engine.stream_error(self._engine_values())
        if error:
            problems.append(error)
        if problems:
            raise ValueError(" ".join(problems))
        self._stream = _engine.Stream(self._engine_values(), int(self._values["ReservoirSize"]))
        return self._stream

    def add_cloud(self, cloud: Cloud) -> list[str]:
        """Add points. Returns what was left out of what they bring, in words."""
        stream = self.prepare()
        problems: list[str] = []
        if len(cloud) > 0:
            stream.add_points(
                [block.points for block in cloud.blocks], **self._sides(cloud, problems)
            )
        return problems

    def learn(self, samples: int, progress: Progress | None = None) -> int:
        """Learn this number of samples. Returns the number learnt."""
        learnt = self.prepare().learn(max(0, int(samples)), progress)
        self.Modified()
        return learnt

    def learn_for_seconds(self, seconds: float, progress: Progress | None = None) -> int:
        """Learn so long, about; how many samples they were."""
        learnt = self.prepare().learn_for_seconds(float(seconds), progress)
        self.Modified()
        return learnt

    def mesh(self, progress: Progress | None = None) -> Mesh | None:
        """The mesh learnt so far, or nothing."""
        if self._stream is None:
            return None
        finished = bool(self._values["FinishOutput"])
        mesh = self._stream.mesh(finished, **self._sides(None, []), progress=progress)
        return Mesh(**mesh) if mesh else None

    def Reset(self) -> None:
        """Forget points and mesh."""
        self._stream = None
        self.Modified()

    def _count(self, name: str) -> int:
        return getattr(self._stream, name) if self._stream is not None else 0

    def GetNumberOfAddedPoints(self) -> int:
        """Points that came and are finite."""
        return self._count("points")

    def GetNumberOfDroppedPoints(self) -> int:
        """Points that are not."""
        return self._count("dropped_points")

    def GetNumberOfLearntSamples(self) -> int:
        """Samples that were learnt."""
        return self._count("samples")

    def GetNumberOfLearntVertices(self) -> int:
        """Vertices of the mesh as it is."""
        return self._count("vertices")

    def GetNumberOfBeginnings(self) -> int:
        """How often the mesh was begun."""
        return self._count("beginnings")
