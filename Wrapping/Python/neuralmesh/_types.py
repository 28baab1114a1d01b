# SPDX-License-Identifier: BSD-3-Clause
"""Types in the signatures of the functions.

Where VTK is installed a mesh is a vtkPolyData, of which pyvista.PolyData is a subclass. Where it is not, type
checkers take vtkPolyData for anything: there a mesh is a neuralmesh.Mesh, which the functions take
beside VTK, too, unless the C++ classes are there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable

from numpy.typing import ArrayLike

from ._build import VTK_VERSION

if TYPE_CHECKING or VTK_VERSION:
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPointSet, vtkPolyData
else:
    vtkCompositeDataSet = vtkPointSet = vtkPolyData = Any

if TYPE_CHECKING or not VTK_VERSION:
    from .engine.mesh import Mesh
else:
    Mesh = vtkPolyData

# What the functions return: a vtkPolyData, a pyvista.PolyData or a neuralmesh.Mesh as the points were, and
# with explain or feature_lines several of them. Hints that said it would be wrong for some.
MadeMesh = Any

__all__ = [
    "ArrayLike",
    "MadeMesh",
    "Mesh",
    "Progress",
    "vtkCompositeDataSet",
    "vtkPointSet",
    "vtkPolyData",
]

Progress = Callable[[float], "bool | None"]
