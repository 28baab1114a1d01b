# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, explained points and feature lines as NumPy arrays, and as objects of VTK and PyVista."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .._arrays import as_points, as_triangles
from .._kinds import vtk_package, vtk_package_of
from .vtk_arrays import field_array, named, polygons_of, vtk_module, vtk_points

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkPolyData


@dataclass
class Mesh:
    """Triangles, or lines, or points alone, as NumPy arrays.

    Attributes:
        points: Shape (N, 3), 4- or 8-byte floats.
        triangles: Shape (T, 3), 8-byte integers: the points of each, counter-clockwise as seen from
            outside.
        point_data: An array of N rows for each name.
        field_data: A number, a text, a list of texts, or an array for each name.
        lines: The points of each line, in their order; 8-byte integers.
        corners: The points where lines meet, end or turn sharply.
        cell_data: An array for each name: of a row for each corner, and behind them for each line.
        scalars: The name of the point data by which VTK colours the mesh; empty for none.
    """

    points: np.ndarray
    triangles: np.ndarray
    point_data: dict[str, Any] = field(default_factory=dict)
    field_data: dict[str, Any] = field(default_factory=dict)
    scalars: str = ""
    # Arrays of VTK by the names of point data that is to be of the same kind there.
    vtk_kinds: dict[str, Any] = field(default_factory=dict, repr=False, compare=False)
    lines: list[np.ndarray] = field(default_factory=list)
    corners: np.ndarray | None = None
    cell_data: dict[str, Any] = field(default_factory=dict)
    # What the point data `Normals` is called where it came from.
    normals_name: str = field(default="Normals", repr=False, compare=False)

    @property
    def warnings(self) -> list[str]:
        """What must be known of the mesh, a sentence each."""
        return list(self.field_data.get("Warnings", ()))

    def __repr__(self) -> str:
        if self.lines:
            return f"<neuralmesh.Mesh of {len(self.points)} points and {len(self.lines)} lines>"
        return f"<neuralmesh.Mesh of {len(self.points)} points and {len(self.triangles)} triangles>"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the mesh, in the format that the extension tells: .ply .stl .obj .off .glb, .xyz and .npy
        for points alone; where VTK is installed, .vtp and .vtk, too.

        Raises:
            ValueError: The format is another one, or has no room for the digits of the coordinates.
            OSError: The file cannot be written.
        """
        from .files import write_mesh

        write_mesh(self, path)

    def to_vtk(self) -> vtkPolyData:
        """A vtkPolyData that refers to these arrays.

        Raises:
            ImportError: There is no VTK.
        """
        return self.to_vtk_of(vtk_package())

    def to_vtk_of(self, package: str | None) -> vtkPolyData:
        """The same with classes of this package of VTK."""
        result = vtk_module(package, "vtkCommonDataModel").vtkPolyData()
        self.fill(result)
        return result

    def to_pyvista(self) -> Any:
        """The same as a pyvista.PolyData.

        Raises:
            ImportError: There is no PyVista.
        """
        import pyvista

        return pyvista.wrap(self.to_vtk())

    def fill(self, data: vtkPolyData) -> None:
        """Give a vtkPolyData the points, triangles and data."""
        package = vtk_package_of(data)
        support = vtk_module(package, "util.numpy_support")
        data.SetPoints(vtk_points(self.points, package))
        cells = vtk_module(package, "vtkCommonDataModel").vtkCellArray()
        if len(self.triangles) > 0:
            # VTK may keep the memory of these without the array that it was given.
            corners = np.ascontiguousarray(self.triangles, dtype=np.int64)
            cells.SetData(3, support.numpy_to_vtkIdTypeArray(corners.reshape(-1), deep=True))
            data.SetPolys(cells)
        elif self.corners is not None:
            data.SetVerts(_cells_of(self.corners[:, None], package))
            data.SetLines(_cells_of(self.lines, package))
        elif len(self.points) > 0:
            # Points alone are to be seen, too: all are one cell.
            data.SetVerts(_cells_of([np.arange(len(self.points))], package))
        for name, values in self.point_data.items():
            array = named(values, name, package, self.vtk_kinds.get(name))
            if name == "Normals":
                data.GetPointData().SetNormals(array)
            elif name == self.scalars:
                data.GetPointData().SetScalars(array)
            else:
                data.GetPointData().AddArray(array)
        for name, values in self.cell_data.items():
            data.GetCellData().AddArray(named(values, name, package))
        for name, value in self.field_data.items():
            data.GetFieldData().AddArray(field_array(value, name, package))


def _cells_of(cells: Any, package: str | None) -> Any:
    """A vtkCellArray of cells with these points."""
    support = vtk_module(package, "util.numpy_support")
    result = vtk_module(package, "vtkCommonDataModel").vtkCellArray()
    ends = np.cumsum([0, *(len(cell) for cell in cells)], dtype=np.int64)
    points = np.concatenate([np.empty(0, dtype=np.int64), *cells]).astype(np.int64)
    result.SetData(
        support.numpy_to_vtkIdTypeArray(ends, deep=True),
        support.numpy_to_vtkIdTypeArray(points, deep=True),
    )
    return result


def as_mesh(surface: Any, parameter: str) -> Mesh:
    """The triangles of a Mesh, a vtkPolyData, or a pair of points and triangles. ValueError for anything
    else, which names the parameter.
    """
    if isinstance(surface, Mesh):
        points, triangles = np.asarray(surface.points), np.asarray(surface.triangles)
        for name, array, kinds in (("points", points, "fiu"), ("triangles", triangles, "iu")):
            if array.shape[1:] != (3,) or array.dtype.kind not in kinds:
                raise ValueError(
                    f"{parameter}: {name} of a mesh must be numbers of shape (N, 3), not of shape "
                    f"{array.shape} and type {array.dtype}"
                )
        return surface
    if isinstance(surface, tuple) and len(surface) == 2:
        points, triangles = as_points(surface[0]), as_triangles(surface[1], parameter)
        return Mesh(points, triangles.astype(np.int64, copy=False))
    elif hasattr(surface, "GetPolys") and hasattr(surface, "GetPoints"):
        return Mesh(*polygons_of(surface))
    wanted = (
        "a vtkPolyData"
        if vtk_package()
        else "a neuralmesh.Mesh, or a pair of arrays, points and triangles"
    )
    raise ValueError(f"{parameter} must be {wanted}, not {type(surface).__name__}")
