# SPDX-License-Identifier: BSD-3-Clause
"""Triangle meshes of a wanted size from raw point clouds, by learning.

>>> import neuralmesh
>>> mesh = neuralmesh.reconstruct(points, vertices=20000)

reconstruct() makes a mesh in one call, remesh() makes other triangles of a surface, and stream() learns while
points arrive. compare() measures the distance of a mesh from a reference, explain() finds the points that it
leaves out, info() checks whether it is sound. Pipelines use the VTK classes, such as vtkNeuralMesh. Meshes and
other VTK objects have the methods of the package vtkmodules. If this package was built with a VTK, VTK_VERSION,
vtkmodules must be of the same version. The package from PyPI was built without VTK: it works with any VTK. Without
VTK, a mesh is a neuralmesh.Mesh.
"""

from ._build import VERSION as __version__, VTK_VERSION

if VTK_VERSION:
    from . import _vtk

    _vtk.require_vtk(VTK_VERSION)
else:
    from . import _own_engine

    _own_engine.require_engine(__version__)

from . import _pyvista_hook
from ._compare import compare
from ._explain import explain
from ._info import info
from ._reconstruct import reconstruct
from ._remesh import remesh
from ._stream import stream

if VTK_VERSION:
    from .vtkFiltersNeuralMesh import *
else:
    from .engine.files import read
    from .engine.mesh import Mesh

    def __getattr__(name: str):
        """The classes for pipelines, which import VTK only where they are wanted."""
        return _own_engine.vtk_class(name)

    def __dir__() -> list[str]:
        """What completion proposes: also the classes, where there is a VTK for them."""
        return sorted({*globals(), *_own_engine.vtk_classes()})


_pyvista_hook.install()
