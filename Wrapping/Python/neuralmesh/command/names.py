# SPDX-License-Identifier: BSD-3-Clause
"""Files that are named in the command."""

from __future__ import annotations

import os
import sys
import warnings
from dataclasses import dataclass

from .. import _engine
from ..engine import files
from ..engine.mesh import Mesh
from .parsing import UsageError

POINTS = "Points: .ply .stl .obj .off .pcd .pwn .ptx .npy, or text: .xyz .pts .txt .csv .asc; .vtp .vtk .vtu by VTK; .las .laz .e57 with neuralmesh[lidar]"  # fmt: skip
MESHES = ".ply .stl .obj .off, .vtp .vtk by VTK"
OUTPUTS = (".vtp", ".ply", ".obj", ".stl", ".glb", ".off", ".vtk")
_MESHES = (".ply", ".vtp", ".vtk", ".obj", ".stl", ".off")


# The warnings of files that the command has printed.
told_warnings: list[str] = []


@dataclass
class NamedFile:
    """A file, and the option that names it."""

    option: str
    path: str
    is_written: bool = False


def require_distinct(named: list[NamedFile]) -> None:
    """UsageError where a file that is written is that of another option, too, or one is given twice."""
    for i, one in enumerate(named):
        for other in named[:i]:
            is_twice = one.option == other.option
            counts = is_twice or one.is_written or other.is_written
            if one.path and other.path and counts and _is_same(one.path, other.path):
                what = "given twice" if is_twice else f"the file of {other.option}, too"
                raise UsageError(f"{one.option}: {one.path} is {what}")


def _is_same(one: str, other: str) -> bool:
    try:
        return os.path.samefile(one, other)
    except OSError:  # one of them, or both, are not there yet
        return os.path.realpath(one) == os.path.realpath(other)


def require_output(path: str) -> None:
    """ValueError if no mesh can be written so."""
    if files.extension_of(path) not in OUTPUTS:
        raise ValueError(f"{path}: unknown extension; writable are {' '.join(OUTPUTS)}")
    files.require_writable(path)


def require_explanation(option: str, path: str) -> None:
    """Raise what is wrong with the name of a file of explained points."""
    if files.extension_of(path) != ".vtp":
        raise UsageError(f"{option}: {path} must be a .vtp; no other format keeps it")
    files.require_writable(path)
    _engine.require_place(path)


def require_lines(option: str, path: str) -> None:
    """Raise what is wrong with the name of a file of feature lines."""
    if files.extension_of(path) not in (".vtp", ".vtk"):
        raise UsageError(f"{option}: {path} must be a .vtp or .vtk; no other format keeps lines")
    files.require_writable(path)
    _engine.require_place(path)


def read_points(path: str) -> Mesh:
    """Points, or a mesh. Readers of VTK may end the process where a file is damaged: not without words."""
    if files.extension_of(path) in files.BY_VTK and os.path.isfile(path):
        return _engine.read_guarded(path, files.read)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        points = files.read(path)
    for warning in told:
        print(f"neuralmesh: warning: {warning.message}", file=sys.stderr)
        told_warnings.append(str(warning.message))
    return points


def read_mesh(path: str) -> Mesh:
    """A mesh; ValueError for points."""
    if files.extension_of(path) not in _MESHES:
        raise ValueError(
            f"{path}: no mesh is read from this extension; readable are {' '.join(_MESHES)}"
        )
    mesh = read_points(path)
    if len(mesh.triangles) == 0:
        raise ValueError(f"{path}: there are no triangles in it")
    return mesh
