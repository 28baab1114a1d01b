# SPDX-License-Identifier: BSD-3-Clause
"""vtkNeuralMeshStream for any VTK."""

from __future__ import annotations

from typing import Any

from .. import _engine
from .cloud import as_cloud
from .stream import NeuralMeshStream
from .vtk_learning import vtkNeuralMeshAlgorithm
from .vtk_names import vtkPolyData


class vtkNeuralMeshStream(vtkNeuralMeshAlgorithm, NeuralMeshStream):
    """A mesh that is learnt while points arrive: a source, whose output is the mesh learnt so far."""

    _INPUTS = ()
    _OUTPUTS = ("vtkPolyData",)

    def __init__(self, **properties: Any) -> None:
        vtkNeuralMeshAlgorithm.__init__(self)
        NeuralMeshStream.__init__(self)
        self._set(properties)

    def _is_ready(self) -> bool:
        """Whether there is a stream, or one can be made; an error says why not."""
        if self._stream is not None:
            return True
        if not self.CheckParameters():
            return False
        error = _engine.stream_error(self._engine_values())
        if error:
            self._error(error)
            return False
        self.prepare()
        return True

    def AddPoints(self, points: Any) -> None:
        """Add a vtkPointSet or vtkPoints; they count from the next Learn() on."""
        if not hasattr(points, "GetPointData"):
            data = vtkPolyData()
            data.SetPoints(points)
            points = data
        if not self._is_ready():
            return
        try:
            problems = self.add_cloud(as_cloud(points, blocks=False))
        except (ValueError, RuntimeError) as error:
            self._error(str(error))
            return
        for text in problems:
            self._warn(text)

    def Learn(self, samples: int) -> int:
        """Learn this number of samples. Returns the number learnt."""
        if not self._is_ready():
            return 0
        learnt = self.learn(samples, self._progress())
        self._obey_abort()
        return learnt

    def LearnForSeconds(self, seconds: float) -> int:
        """Learn for about so long. Returns as Learn()."""
        if not self._is_ready():
            return 0
        learnt = self.learn_for_seconds(seconds, self._progress())
        self._obey_abort()
        return learnt

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Puts out the mesh learnt so far."""
        mesh = self.mesh(self._progress())
        self._obey_abort()
        if mesh is not None:
            for text in mesh.warnings:
                self._warn(text)
            mesh.fill(vtkPolyData.GetData(outputs))
        return 1
