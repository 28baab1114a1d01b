# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and of meshes, by their extensions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPointSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkOBJWriter, vtkSTLReader, vtkSTLWriter
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter
from vtkmodules.vtkIOXML import (
    vtkXMLPolyDataReader,
    vtkXMLPolyDataWriter,
    vtkXMLUnstructuredGridReader,
)

from .._execution import execute
from .._points import as_dataset
from .atomic_file import atomic_file


def read_points(path: Path) -> vtkPointSet:
    """Read a scan: .ply .vtp .vtk .vtu .obj .stl, or text: .xyz .pts .txt .csv.

    OSError or ValueError say what is wrong with the file.
    """
    if not path.exists():
        raise FileNotFoundError("there is no such file")
    if not path.is_file():
        raise ValueError("this is no regular file")
    extension = path.suffix.lower()
    if extension in _TEXT:
        return as_dataset(_read_text(path))
    if extension not in _READERS:
        readable = " ".join((*_READERS, *_TEXT))
        raise ValueError(f"unknown extension; readable are {readable}")
    if extension == ".stl":
        _require_whole_stl(path)
    reader = _READERS[extension]()
    reader.SetFileName(str(path))
    execute(reader)
    points = reader.GetOutputDataObject(0)
    if not isinstance(points, vtkPointSet):
        raise ValueError("this holds no point set")
    return points


def read_mesh(path: Path) -> vtkPolyData:
    """Read a mesh to start from: .ply .vtp .vtk .obj .stl.

    OSError or ValueError name the file, and say what is wrong with it.
    """
    try:
        mesh = read_points(path)
        is_mesh = isinstance(mesh, vtkPolyData)
        if not is_mesh or mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips() == 0:
            raise ValueError("there are no triangles in it")
    except (OSError, ValueError, RuntimeError) as error:
        raise ValueError(f"first mesh {path}: {error}") from None
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


def write_mesh(mesh: vtkPolyData, path: Path) -> None:
    """Write a mesh, whole or not at all, in the format that the extension tells."""
    with atomic_file(path) as temporary:
        WRITERS[path.suffix[1:]](mesh, temporary)


_TEXT = (".xyz", ".pts", ".txt", ".csv")
_READERS = {
    ".ply": vtkPLYReader,
    ".vtp": vtkXMLPolyDataReader,
    ".vtk": vtkGenericDataObjectReader,
    ".vtu": vtkXMLUnstructuredGridReader,
    ".obj": vtkOBJReader,
    ".stl": vtkSTLReader,
}


def _read_text(path: Path) -> np.ndarray:
    """The first three numbers of each line, between blanks, commas or semicolons."""
    delimiter, skipped = None, 0
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            words = line.replace(",", " ").replace(";", " ").split()
            if len(words) >= 3 and all(map(_is_number, words[:3])):
                delimiter = next((sign for sign in ",;" if sign in line), None)
                break
            # Names of columns, or a count of points, or a comment.
            skipped += 1
        else:
            raise ValueError("there are no points in it")
    return np.loadtxt(
        path,
        comments=["#", "//"],
        delimiter=delimiter,
        skiprows=skipped,
        usecols=(0, 1, 2),
        ndmin=2,
        encoding="utf-8",
    )


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _require_whole_stl(path: Path) -> None:
    """VTK takes a binary .stl that ends too soon for a shorter one."""
    with open(path, "rb") as file:
        header = file.read(84)
    triangles = int.from_bytes(header[80:], "little")
    if b"\0" in header and path.stat().st_size < 84 + 50 * triangles:
        raise ValueError("damaged: it ends before its last triangle")


def _write_vtp(mesh: vtkPolyData, path: Path) -> None:
    # By way of a string, as VTK 9.2 crashes if the disk is full. Data in the elements, not appended
    # behind them, of which VTK 9.2 reads little with newer versions of expat.
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()
    writer.WriteToOutputStringOn()
    writer.SetInputData(mesh)
    execute(writer)
    path.write_text(writer.GetOutputString(), encoding="utf-8")


def _write_ply(mesh: vtkPolyData, path: Path) -> None:
    writer = vtkPLYWriter()
    colors = colors_of(mesh)
    if colors is not None:
        writer.SetArrayName(colors.GetName())
        writer.SetEnableAlpha(colors.GetNumberOfComponents() == 4)
    _write(writer, vtkPLYReader(), mesh, path)


def _write_obj(mesh: vtkPolyData, path: Path) -> None:
    _write(vtkOBJWriter(), vtkOBJReader(), mesh, path)


def _write_stl(mesh: vtkPolyData, path: Path) -> None:
    writer = vtkSTLWriter()
    writer.SetFileTypeToBinary()
    _write(writer, vtkSTLReader(), mesh, path)


def _write(writer, reader, mesh: vtkPolyData, path: Path) -> None:
    """Write, and read again: these writers do not notice that a disk is full."""
    for algorithm in (writer, reader):
        algorithm.SetFileName(str(path))
    writer.SetInputData(mesh)
    execute(writer)
    execute(reader)
    if reader.GetOutput().GetNumberOfPolys() != mesh.GetNumberOfPolys():
        raise OSError("not all of the mesh could be written; is the disk full?")


WRITERS = {"vtp": _write_vtp, "ply": _write_ply, "obj": _write_obj, "stl": _write_stl}


def colors_of(mesh: vtkPolyData):
    """The colours of the vertices, an array of bytes with 3 or 4 components, or None."""
    scalars = mesh.GetPointData().GetScalars()
    is_color = (
        scalars is not None
        and scalars.GetDataTypeAsString() == "unsigned char"
        and scalars.GetNumberOfComponents() in (3, 4)
    )
    return scalars if is_color and scalars.GetName() else None
