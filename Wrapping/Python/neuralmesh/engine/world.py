# SPDX-License-Identifier: BSD-3-Clause
"""How the functions work where no C++ classes of VTK are: by the engine. _wrapped.py has the same names
for where they are.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from .._arrays import kind_of_numbers, values_of_points
from .._kinds import as_given, vtk_package, vtk_package_of
from .._types import Progress
from .._warning import warn
from .cloud import Cloud, as_cloud
from .measures import NeuralMeshComparison, NeuralMeshExplanation, report
from .mesh import Mesh, as_mesh as take_surface
from .reconstruction import NeuralMesh, NeuralMeshEnsemble
from .stream import NeuralMeshStream

__all__ = [
    "NeuralMesh",
    "NeuralMeshComparison",
    "NeuralMeshEnsemble",
    "NeuralMeshExplanation",
    "NeuralMeshStream",
    "add_points",
    "check_parameters",
    "compare",
    "explain",
    "learn",
    "learn_for_seconds",
    "learn_samples",
    "learnt_mesh",
    "report",
    "take_points",
    "take_polygons",
    "take_surface",
    "with_array",
    "with_normals",
]


def take_points(points: object, blocks: bool = True) -> Cloud:
    """The points as a cloud."""
    return as_cloud(points, blocks)


def take_polygons(surface: object, parameter: str) -> Cloud:
    """A surface as a cloud that knows its triangles. ValueError for anything else."""
    is_composite = hasattr(surface, "IsA") and surface.IsA("vtkCompositeDataSet")
    if is_composite or hasattr(surface, "GetPolys"):
        return as_cloud(surface)
    return as_cloud(take_surface(surface, parameter))


def with_array(cloud: Cloud, values: object, parameter: str, name: str) -> tuple[Cloud, str]:
    """The cloud and the name of an array of it that a parameter gives; where the parameter is an array,
    a copy that refers to the points. ValueError for anything but numbers of shape (N,).
    """
    if isinstance(values, str):
        return cloud, values
    _require_one_block(cloud, parameter, "the name of a point array")
    array = values_of_points(values, len(cloud), parameter, ())
    if not cloud.blocks:
        return cloud, name
    block = cloud.blocks[0]
    data = {**block.data, name: np.ascontiguousarray(array, dtype=kind_of_numbers(name, array))}
    return dataclasses.replace(cloud, blocks=[dataclasses.replace(block, data=data)]), name


def with_normals(cloud: Cloud, normals: object) -> Cloud:
    """The cloud with these normals. ValueError for anything but numbers of shape (N, 3)."""
    _require_one_block(cloud, "normals", "given with the blocks")
    array = values_of_points(normals, len(cloud), "normals", (3,))
    if not cloud.blocks:
        return cloud
    block = dataclasses.replace(cloud.blocks[0], normals=np.asarray(array, dtype=np.float64))
    return dataclasses.replace(cloud, blocks=[block])


def check_parameters(mesh: NeuralMesh) -> None:
    """Raise ValueError if the properties do not go together."""
    problems = mesh.parameter_errors()
    if problems:
        raise ValueError(" ".join(problems))


def learn(
    mesh: NeuralMesh,
    points: Cloud | None,
    first_mesh: Mesh | None,
    progress: Progress | None,
    given: object = None,
) -> tuple[Any, Any, Any, list[Any]]:
    """Run with points, or with the file of the mesh where there are none; mesh, explained points,
    feature lines and smaller levels.
    """
    told = _told(progress)
    outcome = (
        mesh.run_on_file(first_mesh, told) if points is None else mesh.run(points, first_mesh, told)
    )
    if told is not None and mesh.GetStopReason() != "cancelled":
        told(1.0)
    for text in outcome.warnings:
        warn(text)
    return (
        present(outcome.mesh, given),
        present(outcome.explained or _nothing(), given),
        present(outcome.feature_lines or _nothing(), given),
        [present(level, given) for level in outcome.smaller_levels],
    )


def _nothing() -> Mesh:
    return Mesh(np.empty((0, 3)), np.empty((0, 3), dtype=np.int64))


def add_points(stream: NeuralMeshStream, points: Cloud) -> None:
    for text in stream.add_cloud(points):
        warn(text)


def learn_samples(stream: NeuralMeshStream, samples: int, progress: Progress | None) -> int:
    return stream.learn(samples, _told(progress))


def learn_for_seconds(stream: NeuralMeshStream, seconds: float, progress: Progress | None) -> int:
    return stream.learn_for_seconds(seconds, _told(progress))


def learnt_mesh(stream: NeuralMeshStream, progress: Progress | None, given: object = None) -> Any:
    mesh = stream.mesh(_told(progress))
    if mesh is None:
        mesh = Mesh(np.empty((0, 3)), np.empty((0, 3), dtype=np.int64))
    for text in mesh.warnings:
        warn(text)
    return present(mesh, given)


def compare(
    comparison: NeuralMeshComparison, reference: Mesh, result: Mesh
) -> tuple[dict[str, list[Any]], dict[str, float]]:
    """Columns with a row for each direction, and the figures of both directions together; empty if both
    surfaces are empty.
    """
    found = comparison.compare(reference, result)
    return (found.table, found.both_ways) if found else ({}, {})


def explain(
    explanation: NeuralMeshExplanation,
    points: Cloud,
    mesh: Mesh,
    progress: Progress | None,
    given: object = None,
) -> Any:
    explained = None
    if len(points) > 0:
        explained = explanation.explain(points, mesh, _told(progress))
    if explained is None:
        explained = Mesh(np.empty((0, 3)), np.empty((0, 3), dtype=np.int64))
    return present(explained, given)


def present(mesh: Mesh, given: object) -> Any:
    """A mesh as who has given that has it: as PyVista or VTK, or as it is; for arrays as VTK, too, if there
    is one.
    """
    if isinstance(given, Mesh):
        return mesh
    package = vtk_package_of(given) or vtk_package()
    return mesh if package is None else as_given(mesh.to_vtk_of(package), given)


def _told(progress: Progress | None) -> Progress | None:
    """The same function, with a False of Python where it returns one of NumPy."""
    if progress is None:
        return None

    def tell(fraction: float) -> bool:
        go_on = progress(fraction)
        return not (isinstance(go_on, (bool, np.bool_)) and not go_on)

    return tell


def _require_one_block(cloud: Cloud, parameter: str, other: str) -> None:
    if cloud.is_in_blocks:
        raise ValueError(f"{parameter} must be {other} where points are in blocks")
