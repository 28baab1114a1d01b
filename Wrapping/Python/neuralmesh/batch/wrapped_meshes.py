# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and of meshes where the C++ classes of VTK are: by these. engine_meshes.py has the same
names for where they are not.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPointSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

from .._execution import execute, observed_call
from ..vtkFiltersNeuralMesh import (
    vtkNeuralMeshPLYReader,
    vtkNeuralMeshReader,
    vtkNeuralMeshWriter,
)
from .atomic_file import atomic_file

__all__ = [
    "DEFAULT_FORMAT",
    "FORMATS",
    "arrays_of",
    "counts_of",
    "fields_of",
    "problem_of_format",
    "read_mesh",
    "read_points",
    "require_digits",
    "to_vtk",
    "why_no_pictures",
    "write_mesh",
]

FORMATS = ("vtp", "ply", "obj", "stl", "glb", "off", "vtk")
DEFAULT_FORMAT = "vtp"


def problem_of_format(mesh_format: str) -> str:
    """Why meshes cannot be written in one of the FORMATS; empty, as they can."""
    return ""


def why_no_pictures() -> str:
    """Why meshes cannot be drawn; empty, as there is a VTK for that."""
    return ""


def read_points(path: Path) -> vtkPointSet:
    """Read a scan: .ply .vtp .vtk .vtu .obj .stl .off .pcd .ptx .pwn, or text: .xyz .pts .txt .csv .asc.

    OSError or ValueError say what is wrong with the file; of .las, .laz and .e57 with the command that
    makes text of them.
    """
    if not path.exists():
        raise FileNotFoundError("there is no such file")
    if not path.is_file():
        raise ValueError("this is no regular file")
    extension = path.suffix.lower()
    if extension not in _READERS:
        readable = " ".join(_READERS)
        conversion = vtkNeuralMeshReader.GetConversion(str(path))
        raise ValueError(conversion or f"unknown extension; readable are {readable}")
    _require_end(path, extension)
    reader = _READERS[extension]()
    reader.SetFileName(str(path))
    execute(reader)
    points = reader.GetOutputDataObject(0)
    if not isinstance(points, vtkPointSet):
        raise ValueError("this holds no point set")
    if points.GetNumberOfPoints() == 0 and extension in _TEXT:
        raise ValueError("there are no points in it")
    vtkNeuralMeshWriter.UndoShift(str(path), points)
    return points


def read_mesh(path: Path) -> vtkPolyData:
    """Read a mesh to start from: .ply .vtp .vtk .obj .stl .off.

    OSError or ValueError name the file, and say what is wrong with it.
    """
    try:
        mesh = read_points(path)
        if (
            not isinstance(mesh, vtkPolyData)
            or mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips() == 0
        ):
            raise ValueError("there are no triangles in it")
    except (OSError, ValueError, RuntimeError) as error:
        # Some readers name the file themselves.
        raise ValueError(f"first mesh {path}: {str(error).removeprefix(f'{path}: ')}") from None
    # VTK takes the points of an .obj apart where there are normals or texture coordinates.
    is_apart = path.suffix.lower() == ".obj" and mesh.GetPointData().GetNumberOfArrays() > 0
    return _merge_equal_points(mesh) if is_apart else mesh


def _merge_equal_points(mesh: vtkPolyData) -> vtkPolyData:
    clean = vtkCleanPolyData()
    clean.ToleranceIsAbsoluteOn()
    clean.SetAbsoluteTolerance(0.0)
    # What degenerates is to be reported, not turned into lines.
    clean.ConvertLinesToPointsOff()
    clean.ConvertPolysToLinesOff()
    clean.ConvertStripsToPolysOff()
    clean.SetInputData(mesh)
    execute(clean)
    return clean.GetOutput()


def mesh_writer(path: Path, shift: Any = None) -> vtkNeuralMeshWriter:
    """A writer of the format that the extension tells; shift is None, "auto" or three numbers."""
    writer = vtkNeuralMeshWriter()
    writer.SetFileName(str(path))
    writer.SetAutomaticShift(shift == "auto")
    if shift not in (None, "auto"):
        writer.SetShift(*shift)
    return writer


def require_digits(points: vtkPointSet, vertices: int, path: Path, shift: Any = None) -> None:
    """Raise ValueError if the format cannot hold the digits of a mesh of these points."""
    writer = mesh_writer(path, shift)
    observed_call(writer, None, writer.CheckCoordinates, points, vertices)


def write_mesh(mesh: vtkPolyData, path: Path, shift: Any = None) -> list[float]:
    """Write a mesh, completely or not at all. Returns the shift.

    The format is that of the extension; shift is None, "auto" or three numbers.
    """
    with atomic_file(path) as temporary:
        writer = mesh_writer(temporary, shift)
        writer.SetInputData(mesh)
        execute(writer)
    return list(writer.GetStoredShift())


_TEXT = (".xyz", ".pts", ".txt", ".csv", ".asc")
_READERS = {
    ".ply": vtkNeuralMeshPLYReader,
    ".vtp": vtkXMLPolyDataReader,
    ".vtk": vtkGenericDataObjectReader,
    ".vtu": vtkXMLUnstructuredGridReader,
    ".obj": vtkOBJReader,
    ".stl": vtkSTLReader,
    ".off": vtkNeuralMeshReader,
    ".pcd": vtkNeuralMeshReader,
    ".ptx": vtkNeuralMeshReader,
    ".pwn": vtkNeuralMeshReader,
    ".xyz": vtkNeuralMeshReader,
    ".pts": vtkNeuralMeshReader,
    ".txt": vtkNeuralMeshReader,
    ".csv": vtkNeuralMeshReader,
    ".asc": vtkNeuralMeshReader,
}


def _require_end(path: Path, extension: str) -> None:
    """Raise ValueError if the file ends early; of .ply its reader knows. VTK takes an .stl that ends
    too soon for a shorter one, and not all versions of it notice that data which is appended does.
    """
    with open(path, "rb") as file:
        header = file.read(84)
        size = file.seek(0, 2)
        file.seek(max(size - 1024, 0))
        end = file.read()
    is_binary = b"\0" in header
    if extension == ".stl" and is_binary:
        if size < 84 + 50 * int.from_bytes(header[80:], "little"):
            raise ValueError("damaged: it ends before its last triangle")
    elif extension in _ENDS and _ENDS[extension] not in end:
        raise ValueError(f"damaged: it ends before its {_ENDS[extension].decode()}")


_ENDS = {".vtp": b"</VTKFile>", ".vtu": b"</VTKFile>", ".stl": b"endsolid"}


def counts_of(mesh: Any) -> tuple[int, int]:
    """How many points and triangles there are."""
    return mesh.GetNumberOfPoints(), mesh.GetNumberOfPolys() if mesh.IsA("vtkPolyData") else 0


def arrays_of(mesh: vtkPolyData) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Points, triangles, and the colours of the points, of shape (N, 3), where there are some."""
    colors = _colors_of(mesh)
    return (
        vtk_to_numpy(mesh.GetPoints().GetData()),
        vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3),
        None if colors is None else vtk_to_numpy(colors)[:, :3],
    )


def fields_of(mesh: vtkPolyData) -> dict[str, Any]:
    """The first value of each array of the field data."""
    fields = mesh.GetFieldData()
    arrays = [fields.GetAbstractArray(i) for i in range(fields.GetNumberOfArrays())]
    return {array.GetName(): array.GetValue(0) for array in arrays if array.GetNumberOfValues() > 0}


def to_vtk(mesh: vtkPolyData) -> vtkPolyData:
    """The mesh as VTK draws it."""
    return mesh


def _colors_of(mesh: vtkPolyData):
    """The colours of the vertices, an array of bytes with 3 or 4 components, or None."""
    scalars = mesh.GetPointData().GetScalars()
    is_color = (
        scalars is not None
        and scalars.GetDataTypeAsString() == "unsigned char"
        and scalars.GetNumberOfComponents() in (3, 4)
    )
    return scalars if is_color and scalars.GetName() else None
