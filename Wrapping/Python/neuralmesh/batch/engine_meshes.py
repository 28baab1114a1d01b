# SPDX-License-Identifier: BSD-3-Clause
"""Files of points and of meshes where no C++ classes of VTK are: by the engine, whatever VTK is there.
wrapped_meshes.py has the same names for where they are.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np

from ..engine import files
from ..engine.mesh import Mesh
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
DEFAULT_FORMAT = "vtp" if files.has_vtk_for(".vtp") else "ply"


def problem_of_format(mesh_format: str) -> str:
    """Why meshes cannot be written in one of the FORMATS; empty if they can."""
    try:
        files.require_writable(f"meshes.{mesh_format}")
    except ValueError as error:
        return str(error).removeprefix(f"meshes.{mesh_format}: ")
    return ""


def why_no_pictures() -> str:
    """Why meshes cannot be drawn; empty if there is a VTK for that."""
    # What draws them is a script of its own, for the package that has VTK's name.
    has_vtk = importlib.util.find_spec("vtkmodules") is not None
    return "" if has_vtk else "no pictures: there is no VTK to draw them (pip install vtk)"


def read_points(path: Path) -> Mesh:
    """Read a scan, as neuralmesh.read() does. OSError or ValueError say what is wrong with the file."""
    if not path.exists():
        raise FileNotFoundError("there is no such file")
    if not path.is_file():
        raise ValueError("this is no regular file")
    points = files.read(path)
    if len(points.points) == 0:
        raise ValueError("there are no points in it")
    return points


def read_mesh(path: Path) -> Mesh:
    """Read a mesh to start from. ValueError names the file, and says what is wrong with it."""
    try:
        mesh = read_points(path)
        if len(mesh.triangles) == 0:
            raise ValueError("there are no triangles in it")
    except (OSError, ValueError) as error:
        # Some readers name the file themselves.
        raise ValueError(f"first mesh {path}: {str(error).removeprefix(f'{path}: ')}") from None
    return mesh


def require_digits(points: Mesh, vertices: int, path: Path, shift: Any = None) -> None:
    """Raise ValueError if the format cannot hold the digits of a mesh of these points."""
    files.require_digits(points.points, vertices, str(path), shift)


def write_mesh(mesh: Any, path: Path, shift: Any = None) -> list[float]:
    """Write a mesh, completely or not at all. Returns the shift.

    The format is that of the extension; shift is None, "auto" or three numbers.
    """
    if not isinstance(mesh, Mesh):
        from ..engine.vtk_files import mesh_of

        mesh = mesh_of(mesh)
    with atomic_file(path) as temporary:
        return list(files.write_mesh(mesh, temporary, shift))


def counts_of(mesh: Mesh) -> tuple[int, int]:
    """How many points and triangles there are."""
    return len(mesh.points), len(mesh.triangles)


def arrays_of(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Points, triangles, and the colours of the points, of shape (N, 3), where there are some."""
    return mesh.points, mesh.triangles, files.colors_of(mesh)


def fields_of(mesh: Mesh) -> dict[str, Any]:
    """The first value of each array of the field data."""
    return {name: _first(value) for name, value in mesh.field_data.items() if np.size(value) > 0}


def to_vtk(mesh: Mesh) -> Any:
    """The mesh as VTK draws it."""
    return mesh.to_vtk()


def _first(value: Any) -> Any:
    if isinstance(value, (list, tuple)):
        return value[0]
    return value.reshape(-1)[0].item() if isinstance(value, np.ndarray) else value
