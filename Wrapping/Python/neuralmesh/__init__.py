# SPDX-License-Identifier: BSD-3-Clause
"""Triangle meshes of a wanted size from raw point clouds, by learning.

>>> import neuralmesh
>>> mesh = neuralmesh.reconstruct(points, vertices=20000)

reconstruct() does it in one call, stream() while points arrive, compare() tells how far a mesh is
from a reference, explain() what it leaves of the points. The VTK classes, vtkNeuralMesh and its sisters, are here for pipelines. The methods
of a mesh and of all VTK objects are those of the package vtkmodules, which must be of the very VTK
that this package was built with: VTK_VERSION.
"""

from . import _vtk
from ._build import VERSION as __version__, VTK_VERSION

_vtk.require_vtk(VTK_VERSION)

from ._compare import compare
from ._explain import explain
from ._reconstruct import reconstruct
from ._stream import stream
from .vtkFiltersNeuralMesh import *
