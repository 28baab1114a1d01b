# SPDX-License-Identifier: BSD-3-Clause
"""Files that VTK reads and writes, by whatever VTK there is."""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

from .._kinds import vtk_package, vtk_package_of
from .cloud import as_cloud
from .files import extension_of
from .mesh import Mesh
from .vtk_arrays import polygons_of, to_numpy, vtk_module

_LAST_BYTES = 1024
_NOTE = "Shift"


def read_by_vtk(path: str) -> Mesh:
    """Read a .vtp, .vtk or .vtu. ValueError if it is none, or damaged."""
    _require_end(path)
    data = _run(path, _reader_of(extension_of(path)))
    if data is None or not data.IsA("vtkPointSet"):
        raise ValueError(f"{path}: this holds no point set")
    if not _has_sound_cells(data):
        raise ValueError(
            f"{path}: damaged: there are cells without corners, or with points that do not exist"
        )
    return _with_shift(mesh_of(data))


def mesh_of(data: Any) -> Mesh:
    """The points of a point set with their data; of a vtkPolyData with its triangles, too."""
    points, triangles = np.empty((0, 3), dtype=np.float32), np.empty((0, 3), dtype=np.int64)
    fields: dict[str, Any] = {}
    for i in range(data.GetFieldData().GetNumberOfArrays()):
        array = data.GetFieldData().GetAbstractArray(i)
        if array.GetName():
            fields[array.GetName()] = _field_of(array)
    cloud = as_cloud(data)
    if not cloud.blocks:
        return Mesh(points, triangles, {}, fields)
    (block,) = cloud.blocks
    point_data: dict[str, Any] = dict(block.data)
    if block.normals is not None:
        point_data["Normals"] = block.normals
    is_whole = len(block.points) == data.GetNumberOfPoints()  # no ghosts among them
    if data.IsA("vtkPolyData") and is_whole:
        triangles = polygons_of(data)[1]
    mesh = Mesh(block.points, triangles, point_data, fields, block.scalars)
    mesh.normals_name = block.normals_name
    return mesh


def vtk_bytes_of(data: Any, extension: str, path: str) -> bytes:
    """What a .vtp or .vtk of a vtkPolyData holds. ValueError if VTK cannot write it."""
    package = vtk_package_of(data)
    if extension == ".vtp":
        writer = vtk_module(package, "vtkIOXML").vtkXMLPolyDataWriter()
        writer.SetDataModeToBinary()
    else:
        writer = vtk_module(package, "vtkIOLegacy").vtkPolyDataWriter()
        writer.SetHeader("NeuralMesh")
        writer.SetFileTypeToBinary()
    writer.WriteToOutputStringOn()
    writer.SetInputData(data)
    problems = _observed(writer, writer.Write)
    # What is no UTF-8 comes as bytes.
    content = writer.GetOutputString() if extension == ".vtp" else writer.GetOutputStdString()
    if problems or not content:
        raise ValueError(f"{path}: cannot be written: {' '.join(problems) or 'VTK gives nothing'}")
    return content.encode("utf-8") if isinstance(content, str) else content


def _reader_of(extension: str) -> Any:
    package = vtk_package()
    if extension == ".vtk":
        return vtk_module(package, "vtkIOLegacy").vtkGenericDataObjectReader()
    name = "vtkXMLPolyDataReader" if extension == ".vtp" else "vtkXMLUnstructuredGridReader"
    return getattr(vtk_module(package, "vtkIOXML"), name)()


def _run(path: str, reader: Any) -> Any:
    reader.SetFileName(path)
    problems = _observed(reader, reader.Update)
    if problems:
        raise ValueError(f"{path}: {problems[0]}")
    return reader.GetOutputDataObject(0)


def _observed(algorithm: Any, work: Callable[[], Any]) -> list[str]:
    """Do the work; what VTK says to be wrong, in words. It prints nothing."""
    problems: list[str] = []
    calldata_type = vtk_module(vtk_package_of(algorithm), "util.misc").calldata_type

    @calldata_type("string0")
    def take(_sender: Any, _event: str, text: str) -> None:
        _, separator, plain = text.partition("): ")
        problems.append(" ".join((plain if separator else text).split()))

    # Readers of XML have a parser that tells by itself.
    senders = [algorithm, algorithm.GetExecutive()]
    tags = [(sender, sender.AddObserver("ErrorEvent", take)) for sender in senders]
    tags += [(sender, sender.AddObserver("WarningEvent", lambda *_: None)) for sender in senders]
    try:
        work()
    finally:
        for sender, tag in tags:
            sender.RemoveObserver(tag)
    return problems


def _require_end(path: str) -> None:
    """Not all versions of VTK notice that data which is appended ends too soon."""
    if extension_of(path) == ".vtk":
        return
    with open(path, "rb") as file:
        size = file.seek(0, 2)
        file.seek(max(size - _LAST_BYTES, 0))
        if b"</VTKFile>" not in file.read():
            raise ValueError(f"{path}: damaged: it ends before its </VTKFile>")


def _has_sound_cells(data: Any) -> bool:
    if not data.IsA("vtkPolyData"):
        return True
    kinds = (
        (data.GetVerts(), 1),
        (data.GetLines(), 2),
        (data.GetPolys(), 3),
        (data.GetStrips(), 3),
    )
    return all(_are_sound(cells, fewest, data.GetNumberOfPoints()) for cells, fewest in kinds)


def _are_sound(cells: Any, fewest: int, points: int) -> bool:
    """Whether all cells have at least `fewest` corners, which are among the points."""
    if not cells or cells.GetNumberOfCells() == 0:
        return True
    offsets = to_numpy(cells.GetOffsetsArray()).astype(np.int64)
    corners = to_numpy(cells.GetConnectivityArray()).astype(np.int64)
    return (
        offsets[0] == 0
        and offsets[-1] == len(corners)
        and bool((np.diff(offsets) >= fewest).all())
        and bool(((corners >= 0) & (corners < points)).all())
    )


def _field_of(array: Any) -> Any:
    values = to_numpy(array)
    if values.dtype == object:
        return [str(text) for text in values.reshape(-1)]
    return values.reshape(-1).item() if values.size == 1 else values


def _with_shift(mesh: Mesh) -> Mesh:
    """The mesh without its shift."""
    shift = mesh.field_data.pop(_NOTE, None)
    if shift is None:
        return mesh
    vector = np.asarray(shift, dtype=np.float64).reshape(-1)
    if vector.shape == (3,) and np.isfinite(vector).all() and vector.any():
        mesh.points = mesh.points.astype(np.float64) + vector
    return mesh
