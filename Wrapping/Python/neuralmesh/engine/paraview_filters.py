# SPDX-License-Identifier: BSD-3-Clause
"""The classes by which the plugin in Python works; paraview_plugin.xml names them."""

from __future__ import annotations

from typing import Any

from vtkmodules.vtkParallelCore import vtkMultiProcessController

from .vtk_filters import (
    vtkNeuralMesh,
    vtkNeuralMeshComparison,
    vtkNeuralMeshEnsemble,
    vtkNeuralMeshExplanation,
    vtkNeuralMeshFileSampler,
    vtkNeuralMeshInformation,
    vtkNeuralMeshScan,
)

__all__ = [
    "vtkNeuralMeshComparison",
    "vtkNeuralMeshExplanation",
    "vtkNeuralMeshFileSampler",
    "vtkNeuralMeshInformation",
    "vtkNeuralMeshScan",
    "vtkPNeuralMesh",
    "vtkPNeuralMeshEnsemble",
]


class _OneProcess:
    """What learns in one process. Several would learn a mesh each, of their part of the points."""

    def _execute(self: Any, inputs: Any, outputs: Any) -> int:
        controller = vtkMultiProcessController.GetGlobalController()
        processes = controller.GetNumberOfProcesses() if controller else 1
        if processes > 1:
            self._error(
                f"The plugin in Python learns in one process, and here are {processes}: the compiled "
                "plugin learns one mesh by all of them."
            )
            return 0
        return super()._execute(inputs, outputs)  # type: ignore[misc]


class vtkPNeuralMesh(_OneProcess, vtkNeuralMesh):
    """vtkNeuralMesh for ParaView."""


class vtkPNeuralMeshEnsemble(_OneProcess, vtkNeuralMeshEnsemble):
    """vtkNeuralMeshEnsemble for ParaView."""
