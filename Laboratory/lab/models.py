# SPDX-License-Identifier: BSD-3-Clause
"""What is scanned: surfaces of Debian packages, surfaces of our own, and files of the user."""

from __future__ import annotations

import functools
import io
import os
import tarfile
from pathlib import Path
from typing import Any, Callable

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPointSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkParametricFunctionSource

from .._execution import execute
from ..batch.meshes import read_mesh, read_points
from ..vtkFiltersNeuralMesh import vtkNeuralMeshScan

_BUNNY = Path("/usr/share/glmark2/models/bunny.obj")
_CGAL_DATA = Path("/usr/share/doc/libcgal-dev/data.tar.gz")
_PACKAGES = {_BUNNY: "glmark2-data", _CGAL_DATA: "libcgal-demo"}
PLATE_THICKNESS = 0.02
# How much sparser the scan of the plate is than that of the pillar on it.
SPARSITY = {"plate": 1, "plate-10": 10, "plate-50": 50}
_ROOM = (0.375, 0.25, 0.375)  # parts of a side of the plate: the middle one is under the pillar


class ModelError(ValueError):
    """What is wrong with a model."""


# Those of our own stand on the plane of x and y, the others on that of x and z.
_UPRIGHT = ("torus", "cube", *SPARSITY)


def up_axis(model: str) -> int:
    return 2 if model in _UPRIGHT else 1


def is_file(model: str) -> bool:
    return model not in SURFACES


def model_name(model: str) -> str:
    """What it is called in tables."""
    return Path(model).stem if is_file(model) else model


def model_identity(model: str) -> list[Any]:
    """What is scanned, as far as it is not told by the name."""
    if not is_file(model):
        return []
    status = Path(model).stat()
    return [status.st_size, status.st_mtime_ns]


def require_models(models: tuple[str, ...]) -> None:
    """Raise ModelError for the first one that is not there, with what to do, or is called as another."""
    names = [model_name(model) for model in models]
    for name in names:
        if names.count(name) > 1:
            raise ModelError(f"two models are called {name}: tables could not tell them apart")
    for model in models:
        path = Path(model) if is_file(model) else _PATHS.get(model)
        if path is None or path.is_file():
            continue
        package = _PACKAGES.get(path)
        hint = f" (Debian: {package})" if package else ""
        raise ModelError(f"{model}: there is no file {path}{hint}")


@functools.lru_cache(maxsize=None)
def surface_of(model: str) -> vtkPolyData | None:
    """The surface itself, by which meshes are judged; none of a file that has only points."""
    if not is_file(model):
        return SURFACES[model]()
    try:
        return read_mesh(Path(model))
    except ValueError:
        return None


@functools.lru_cache(maxsize=8)
def cloud_of(model: str, count: int) -> vtkPointSet:
    """So many points of the surface, always the same ones; all points of a file without one."""
    surface = surface_of(model)
    if surface is None:
        return read_points(Path(model))
    if model in SPARSITY:
        return _append(_scan(_pillar(), count), _scan(_base(), count // SPARSITY[model]))
    return _scan(surface, count)


def _scan(surface: vtkPolyData, count: int) -> vtkPolyData:
    scan = vtkNeuralMeshScan()
    scan.SetInputData(surface)
    scan.SetNumberOfPoints(count)
    execute(scan)
    return scan.GetOutput()


def _bunny() -> vtkPolyData:
    return read_mesh(_BUNNY)


def _of_cgal(name: str) -> Callable[[], vtkPolyData]:
    """meshes/NAME.off, which VTK does not read."""

    def surface() -> vtkPolyData:
        with tarfile.open(_CGAL_DATA) as archive:
            text = archive.extractfile(f"data/meshes/{name}.off").read().decode()
        lines = [line for line in io.StringIO(text) if line.strip() and line[0] != "#"]
        vertices, faces = map(int, lines[1].split()[:2])
        points = np.array([line.split()[:3] for line in lines[2 : 2 + vertices]], float)
        ends = slice(2 + vertices, 2 + vertices + faces)
        triangles = np.array([line.split()[1:4] for line in lines[ends]], np.int64)
        return _poly_data(points, triangles)

    return surface


def _poly_data(points: np.ndarray, triangles: np.ndarray) -> vtkPolyData:
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=True))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(triangles.ravel(), deep=True))
    result = vtkPolyData()
    result.SetPoints(vtk_points)
    result.SetPolys(cells)
    return result


def _torus() -> vtkPolyData:
    torus = vtkParametricTorus()
    torus.SetRingRadius(1.0)
    torus.SetCrossSectionRadius(0.4)
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(torus)
    source.SetUResolution(256)
    source.SetVResolution(128)
    return _triangles(source)


def _cube() -> vtkPolyData:
    return _triangles(vtkCubeSource())


def _pillar() -> vtkPolyData:
    """A pillar without its lower end, on the middle of the base."""
    low, high, side = PLATE_THICKNESS, 1.0, 0.5
    corner = np.array([-side / 2, -side / 2, low])
    x, y, z = np.diag([side, side, high])
    return _parallelograms(
        [(corner, x, z), (corner + x, y, z), (corner + x + y, -x, z), (corner + y, -y, z),
         (corner + z, x, y)]
    )  # fmt: skip


def _base() -> vtkPolyData:
    """A thin plate with room for the pillar."""
    corner = np.array([-1.0, -1.0, 0.0])
    x, y, z = np.diag([2, 2, PLATE_THICKNESS])
    top = [
        (corner + z + x * sum(_ROOM[:i]) + y * sum(_ROOM[:j]), x * _ROOM[i], y * _ROOM[j])
        for i in range(3)
        for j in range(3)
        if (i, j) != (1, 1)
    ]
    return _parallelograms(
        [(corner, y, x), (corner, x, z), (corner + x, y, z), (corner + x + y, -x, z),
         (corner + y, -y, z), *top]
    )  # fmt: skip


def _parallelograms(sides: list[tuple[np.ndarray, np.ndarray, np.ndarray]]) -> vtkPolyData:
    """Each by a corner and what leads to the next ones."""
    corners = np.array([[a, a + u, a + u + v, a + v] for a, u, v in sides], float).reshape(-1, 3)
    first = 4 * np.arange(len(sides))[:, None, None]
    return _poly_data(corners, (first + [[0, 1, 2], [0, 2, 3]]).reshape(-1, 3))


def _plate() -> vtkPolyData:
    return _append(_pillar(), _base())


def _triangles(source: Any) -> vtkPolyData:
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(source.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def _append(*parts: vtkPolyData) -> vtkPolyData:
    append = vtkAppendPolyData()
    for part in parts:
        append.AddInputData(part)
    append.Update()
    return append.GetOutput()


SURFACES: dict[str, Callable[[], vtkPolyData]] = {
    "bunny": _bunny,
    "armadillo": _of_cgal("armadillo"),
    "elephant": _of_cgal("refined_elephant"),
    "hand": _of_cgal("hand"),
    "knot": _of_cgal("knot1"),
    "torus": _torus,
    "cube": _cube,
    **dict.fromkeys(SPARSITY, _plate),
}
# Those by which the thesis's scans are replaced, unless the user names others.
MODELS = ("bunny", "armadillo", "elephant", "hand")
_PATHS = {"bunny": _BUNNY, **dict.fromkeys(("armadillo", "elephant", "hand", "knot"), _CGAL_DATA)}


def absolute(model: str) -> str:
    """A path that holds in any folder, or a name as it is."""
    return os.path.abspath(model) if is_file(model) else model
