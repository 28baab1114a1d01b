# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and meshes, by their extensions: by the engine, and by VTK, laspy and pye57 where these
are installed.
"""

from __future__ import annotations

import importlib.util
import io
import os
from dataclasses import replace
from typing import Any, Callable

import numpy as np

from .. import _engine
from .._arrays import as_points
from .._kinds import vtk_package
from .._warning import warn
from .mesh import Mesh, as_mesh

_BY_ENGINE = (
    ".ply", ".stl", ".obj", ".off", ".pcd", ".pwn", ".ptx", ".xyz", ".pts", ".txt", ".csv",
    ".asc",
)  # fmt: skip
BY_VTK = (".vtp", ".vtk", ".vtu")
_BY_LASPY, _BY_PYE57 = (".las", ".laz"), (".e57",)
READABLE = (*_BY_ENGINE, ".npy", *BY_VTK, *_BY_LASPY, *_BY_PYE57)

_WRITTEN_BY_ENGINE = (".ply", ".stl", ".obj", ".off", ".glb", ".xyz")
_WRITTEN_BY_VTK = (".vtp", ".vtk")
WRITABLE = (*_WRITTEN_BY_ENGINE, ".npy", *_WRITTEN_BY_VTK)

_NO_SHIFT = (0.0, 0.0, 0.0)
_NOTE = "Shift"  # the field data of what was taken off


def extension_of(path: str | os.PathLike[str]) -> str:
    """The extension with its dot, in small letters."""
    return os.path.splitext(os.fspath(path))[1].lower()


def read(path: str | os.PathLike[str]) -> Mesh:
    """Read points or a mesh, in the format that the extension tells.

    Always: .ply .stl .obj .off .pcd .pwn .ptx .npy, and text .xyz .pts .txt .csv .asc. Where VTK is installed:
    .vtp .vtk .vtu, too. With neuralmesh[lidar]: .las .laz .e57. See Documentation/Guide/Formats.md.

    Args:
        path: The file.

    Returns:
        A neuralmesh.Mesh, which reconstruct() and all other functions take; of points alone it has no
        triangles. Point data: `Normals`, `RGB` and `View` where the file has such, and further numbers
        by their names. Field data: `Viewpoints`, where the scanner stood.

    Raises:
        OSError: There is no such file.
        ValueError: It is of another kind, damaged, or ends early; or it takes a package that is not
            installed, which the message names.
        RuntimeWarning: The names of the columns of a text do not tell which are x, y and z.
    """
    name = os.fspath(path)
    if not os.path.exists(name):
        raise FileNotFoundError(f"{name}: there is no such file")
    if not os.path.isfile(name):
        kind = "a folder" if os.path.isdir(name) else "no regular file"
        raise OSError(f"{name}: this is {kind}")
    return _reader_of(name)(name)


def write_mesh(
    mesh: Mesh, path: str | os.PathLike[str], shift: Any = None
) -> tuple[float, float, float]:
    """Write a mesh, completely or not at all. Returns the shift.

    Args:
        mesh: The mesh. A .vtp or a .vtk gets all its point data, others normals and colours.
        path: The file. Its extension is the format: .ply .stl .obj .off .glb, .xyz and .npy for only the
            points; .vtp and .vtk with VTK.
        shift: Vector that is subtracted from the coordinates and stored in the file: None, three
            numbers, or "auto" for a round vector if floats cannot resolve the mesh.

    Raises:
        ValueError: The format is another one, has no room for the digits of the coordinates, or takes
            a package that is not installed; or there is nothing to write.
        OSError: The file cannot be written there.
    """
    name = os.fspath(path)
    require_writable(name)
    try:
        _engine.require_place(name)
    except ValueError as error:
        raise OSError(str(error)) from None
    if len(mesh.points) == 0:
        raise ValueError(f"{name}: cannot be written: there are no points to write")
    mesh = as_mesh(mesh, name)
    extension = extension_of(name)
    if mesh.corners is not None and extension not in _WRITTEN_BY_VTK:
        raise ValueError(f"{name}: lines are written as .vtp or .vtk; no other format keeps them")
    if extension == ".npy":
        if shift is not None:
            raise ValueError(f"{name}: cannot be written: an .npy has no place to note a shift")
        _engine.write_whole(name, _npy_of(as_points(mesh.points)))
        return _NO_SHIFT
    if extension in _WRITTEN_BY_VTK:
        return _write_by_vtk(mesh, name, shift)
    return _engine.write_mesh(
        name,
        as_points(mesh.points),
        np.ascontiguousarray(mesh.triangles, dtype=np.int64).reshape(-1, 3),
        _contiguous(mesh.point_data.get("Normals"), np.float32),
        _contiguous(colors_of(mesh), np.uint8),
        None if shift == "auto" else _three(shift),
        _noted(mesh),
    )


def has_vtk_for(extension: str) -> bool:
    """Whether there is a VTK with the module for these files; cvista lacks some."""
    package = vtk_package()
    module = "vtkIOLegacy" if extension == ".vtk" else "vtkIOXML"
    return package is not None and importlib.util.find_spec(f"{package}.{module}") is not None


def require_writable(path: str) -> None:
    """ValueError if the format cannot be written, or not without a package."""
    extension = extension_of(path)
    if extension not in WRITABLE:
        raise ValueError(f"{path}: unknown extension; writable are {' '.join(WRITABLE)}")
    if extension in _WRITTEN_BY_VTK and not has_vtk_for(extension):
        raise ValueError(f"{path}: {extension} files are written by VTK: pip install vtk")


def require_digits(points: np.ndarray, vertices: int, path: str, shift: Any = None) -> None:
    """ValueError if the format cannot hold the digits of a mesh of this number of vertices."""
    if shift != "auto" and len(points) > 0:
        _engine.require_digits(path, as_points(points), vertices, _three(shift))


def colors_of(mesh: Mesh) -> np.ndarray | None:
    """The colours of the vertices, bytes of shape (N, 3), or None."""
    colors = mesh.point_data.get(mesh.scalars)
    if (
        colors is None
        or colors.dtype != np.uint8
        or colors.ndim != 2
        or colors.shape[1] not in (3, 4)
    ):
        return None
    return colors[:, :3]


def missing_package(path: str, what: str, package: str) -> ValueError:
    """The error that names what to install."""
    return ValueError(
        f"{path}: {extension_of(path)} files are read by {what}: pip install {package}"
    )


def _reader_of(path: str) -> Callable[[str], Mesh]:
    extension = extension_of(path)
    if extension in _BY_ENGINE:
        return _read_by_engine
    if extension == ".npy":
        return _read_npy
    if extension in BY_VTK:
        if not has_vtk_for(extension):
            raise missing_package(path, "VTK", "vtk")
        from .vtk_files import read_by_vtk

        return read_by_vtk
    if extension in _BY_LASPY + _BY_PYE57:
        from .lidar_files import read_e57, read_las

        return read_las if extension in _BY_LASPY else read_e57
    if extension in (".gz", ".bz2", ".xz", ".zip", ".7z"):
        raise ValueError(f"{path}: unpack it first: {extension} files are packed")
    raise ValueError(f"{path}: unknown extension; readable are {' '.join(READABLE)}")


def _read_by_engine(path: str) -> Mesh:
    found = _engine.read_points(path)
    data: dict[str, Any] = dict(found["arrays"])
    fields: dict[str, Any] = {}
    if "normals" in found:
        data["Normals"] = found["normals"]
    if "colors" in found:
        data["RGB"] = found["colors"]
    if "viewpoints" in found:
        fields["Viewpoints"] = found["viewpoints"]
    if "views" in found:
        data["View"] = view_numbers(found["views"])
    if found["missing_returns"]:
        fields["MissingReturns"] = found["missing_returns"]
    if found["remark"]:
        warn(f"{path}: {found['remark']}")
    triangles = found["triangles"].astype(np.int64)
    return Mesh(found["points"], triangles, data, fields, "RGB" if "colors" in found else "")


def view_numbers(views: np.ndarray) -> np.ndarray:
    """Numbers of views as point data has them: -1 where none is known."""
    return np.asarray(views, dtype=np.uint32).view(np.int32)


def _read_npy(path: str) -> Mesh:
    try:
        with open(path, "rb") as file:
            content = np.load(file, allow_pickle=False)
        points = as_points(content)
    except OSError:
        raise
    except Exception as error:  # NumPy parses the header as Python, with all that this raises
        raise ValueError(
            f"{path}: no .npy of numbers of shape (N, 3), or damaged: {error}"
        ) from None
    return Mesh(points, np.empty((0, 3), dtype=np.int64))


def _npy_of(points: np.ndarray) -> bytes:
    content = io.BytesIO()
    np.save(content, points, allow_pickle=False)
    return content.getvalue()


def _write_by_vtk(mesh: Mesh, path: str, shift: Any) -> tuple[float, float, float]:
    from .vtk_files import vtk_bytes_of

    taken = _three(shift) if shift != "auto" else _NO_SHIFT
    if shift == "auto" and mesh.points.dtype == np.float64:
        taken = _engine.round_shift(as_points(mesh.points))
    if not np.isfinite(taken).all():
        raise ValueError(f"{path}: cannot be written: the shift is not finite")
    noted = _three(one + other for one, other in zip(_noted(mesh), taken))
    if any(taken):
        fields = {name: value for name, value in mesh.field_data.items() if name != _NOTE}
        if any(noted):
            fields[_NOTE] = np.array([noted])
        points = (mesh.points - np.array(taken)).astype(mesh.points.dtype)
        mesh = replace(mesh, points=points, field_data=fields)
    _engine.write_whole(path, vtk_bytes_of(mesh.to_vtk(), extension_of(path), path))
    return noted


def _three(shift: Any) -> tuple[float, float, float]:
    if shift is None:
        return _NO_SHIFT
    x, y, z = (float(number) for number in shift)
    return (x, y, z)


def _noted(mesh: Mesh) -> tuple[float, float, float]:
    noted = np.asarray(mesh.field_data.get(_NOTE, _NO_SHIFT), dtype=np.float64).reshape(-1)
    return _three(noted) if len(noted) == 3 and np.isfinite(noted).all() else _NO_SHIFT


def _contiguous(values: np.ndarray | None, kind: Any) -> np.ndarray | None:
    return None if values is None else np.ascontiguousarray(values, dtype=kind)
