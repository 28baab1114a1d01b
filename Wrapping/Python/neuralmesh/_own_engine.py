# SPDX-License-Identifier: BSD-3-Clause
"""Looks after it that the engine is there, and brings the VTK classes that are written in Python."""

from __future__ import annotations

import importlib.util
from typing import Any

_CLASSES = (
    "vtkNeuralMesh",
    "vtkNeuralMeshAlgorithm",
    "vtkNeuralMeshComparison",
    "vtkNeuralMeshEnsemble",
    "vtkNeuralMeshExplanation",
    "vtkNeuralMeshFileSampler",
    "vtkNeuralMeshInformation",
    "vtkNeuralMeshScan",
    "vtkNeuralMeshStream",
)


def require_engine(version: str) -> None:
    """Raise ImportError unless the engine is there, of the same version as the package."""
    try:
        import numpy  # noqa: F401 (the engine speaks of its arrays)
    except ImportError as error:
        raise ImportError(f"neuralmesh needs NumPy ({error}): pip install numpy") from error
    try:
        from . import _engine
    except ImportError as error:
        raise ImportError(
            f"neuralmesh has no engine for this Python and machine ({error}). Wheels are for Linux on "
            "x86-64 and Python 3.11 or later; elsewhere, pip install --no-binary neuralmesh neuralmesh "
            "compiles it, with a compiler for C++20."
        ) from error
    if _engine.version != version:
        raise ImportError(
            f"neuralmesh {version} found an engine of version {_engine.version}, {_engine.__file__}: "
            "two versions lie in one folder. Remove it, and install neuralmesh again."
        )


def vtk_classes() -> tuple[str, ...]:
    """The names of the classes for pipelines; none where there is no VTK. Does not import VTK."""
    return _CLASSES if importlib.util.find_spec("vtkmodules") else ()


def vtk_class(name: str) -> Any:
    """A class for pipelines. AttributeError for other names, ImportError where there is no VTK."""
    if name not in _CLASSES:
        raise AttributeError(f"module 'neuralmesh' has no attribute '{name}'")
    try:
        from .engine import vtk_filters
    except ImportError as error:
        raise ImportError(
            f"neuralmesh.{name} needs VTK ({error}): pip install vtk. The functions of neuralmesh "
            "work without it."
        ) from error
    return getattr(vtk_filters, name)
