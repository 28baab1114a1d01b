# SPDX-License-Identifier: BSD-3-Clause
"""Types in the signatures of the functions.

Where VTK is installed a mesh is a vtkPolyData, of which pyvista.PolyData is a subclass. Where it is not, type
checkers take vtkPolyData for anything: there a mesh is a neuralmesh.Mesh, which the functions take
beside VTK, too, unless the C++ classes are there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Protocol

from numpy.typing import ArrayLike

from ._build import VTK_VERSION

if TYPE_CHECKING or VTK_VERSION:
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPointSet, vtkPolyData
else:
    vtkCompositeDataSet = vtkPointSet = vtkPolyData = Any

# Subclasses of vtkPolyData; this package does not import PyVista by itself.
if TYPE_CHECKING:
    from pyvista import PolyData as PyVistaMesh
else:
    PyVistaMesh = Any

if TYPE_CHECKING or not VTK_VERSION:
    from .engine.mesh import Mesh
else:
    Mesh = vtkPolyData


class OfPyVista(Protocol):
    """A dataset of PyVista, where that is installed. Nothing is one where it is not: the name of a class would
    stand for anything there.
    """

    def copy_meta_from(self, *arguments: Any, **parameters: Any) -> Any: ...


# What the functions return in one of several cases: a vtkPolyData, a pyvista.PolyData or a neuralmesh.Mesh as
# the points were, and with explain, feature_lines or levels several of them.
MadeMesh = Any

__all__ = [
    "ArrayLike",
    "MadeMesh",
    "Mesh",
    "OfPyVista",
    "Progress",
    "PyVistaMesh",
    "vtkCompositeDataSet",
    "vtkPointSet",
    "vtkPolyData",
]

Progress = Callable[[float], "bool | None"]
