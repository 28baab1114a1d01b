# SPDX-License-Identifier: BSD-3-Clause
"""What was given to a function, and what it gives back for that."""

from __future__ import annotations

import importlib.util
from typing import Any


def is_pyvista(data: object) -> bool:
    """Whether it is an object of PyVista."""
    return any(cls.__module__.partition(".")[0] == "pyvista" for cls in type(data).__mro__)


def is_vtk(data: object) -> bool:
    """Whether it is a dataset of any VTK, or a composite of some."""
    return hasattr(data, "GetPointData") or hasattr(data, "NewIterator")


def has_vtk() -> bool:
    """Whether there is a VTK to import."""
    return importlib.util.find_spec("vtkmodules") is not None


def as_given(result: Any, given: object) -> Any:
    """A vtkPolyData as it is, or as PyVista has it where that was given."""
    if not is_pyvista(given):
        return result
    import pyvista

    return pyvista.wrap(result)
