# SPDX-License-Identifier: BSD-3-Clause
"""The classes for pipelines where no C++ classes are: the same names, properties, ports and bytes, for
any VTK, on VTKPythonAlgorithmBase.
"""

from .vtk_learning import vtkNeuralMesh, vtkNeuralMeshAlgorithm, vtkNeuralMeshEnsemble
from .vtk_measures import (
    vtkNeuralMeshComparison,
    vtkNeuralMeshExplanation,
    vtkNeuralMeshFileSampler,
    vtkNeuralMeshInformation,
    vtkNeuralMeshScan,
)
from .vtk_stream import vtkNeuralMeshStream

__all__ = [
    "vtkNeuralMesh",
    "vtkNeuralMeshAlgorithm",
    "vtkNeuralMeshComparison",
    "vtkNeuralMeshEnsemble",
    "vtkNeuralMeshExplanation",
    "vtkNeuralMeshFileSampler",
    "vtkNeuralMeshInformation",
    "vtkNeuralMeshScan",
    "vtkNeuralMeshStream",
]
