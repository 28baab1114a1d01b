# SPDX-License-Identifier: BSD-3-Clause
"""Triangle meshes of a wanted size from raw point clouds, by learning.

>>> import neuralmesh
>>> mesh = neuralmesh.reconstruct(points, vertices=20000)

reconstruct() does it in one call, remesh() makes other triangles of a surface, stream() while points arrive, compare() tells how far a mesh is
from a reference, explain() what it leaves of the points, info() whether it is sound. The VTK classes,
vtkNeuralMesh and its sisters, are here for pipelines. The methods of a mesh and of all VTK objects are
those of the package vtkmodules. Where this package was built with a VTK, VTK_VERSION, vtkmodules must be of that very one.
What pip installs was built without: there any VTK will do, or none, and a mesh is a neuralmesh.Mesh then.
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


_pyvista_hook.install()
