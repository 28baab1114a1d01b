# SPDX-License-Identifier: BSD-3-Clause
"""The function remesh()."""

from __future__ import annotations

from typing import Any, Literal, overload

from . import _world
from ._parameters import refuse_unknown
from ._reconstruct import PARAMETERS, make_filter, require_points
from ._types import (
    ArrayLike,
    MadeMesh,
    Mesh,
    OfPyVista,
    Progress,
    PyVistaMesh,
    vtkCompositeDataSet,
    vtkPolyData,
)

# Properties, and what reconstruct() names and hands on to them.
_KNOWN = [
    *(name for name in PARAMETERS if name != "input_is"),
    "variant",
    "order",
    "preset",
    "ensemble",
    "viewpoints",
    "up",
]


# fmt: off
@overload
def remesh(
    surface: OfPyVista, vertices: int = ..., seed: int = ..., *,
    feature_lines: Literal[False] = ..., progress: Progress | None = ..., **parameters: float | bool | str,
) -> PyVistaMesh: ...
@overload
def remesh(
    surface: Mesh, vertices: int = ..., seed: int = ..., *,
    feature_lines: Literal[False] = ..., progress: Progress | None = ..., **parameters: float | bool | str,
) -> Mesh: ...
@overload
def remesh(
    surface: vtkPolyData | vtkCompositeDataSet | tuple[ArrayLike, ArrayLike], vertices: int = ..., seed: int = ..., *,
    feature_lines: Literal[False] = ..., progress: Progress | None = ..., **parameters: float | bool | str,
) -> vtkPolyData: ...
@overload
def remesh(
    surface: OfPyVista, vertices: int = ..., seed: int = ..., *,
    feature_lines: Literal[True], progress: Progress | None = ..., **parameters: float | bool | str,
) -> tuple[PyVistaMesh, PyVistaMesh]: ...
@overload
def remesh(
    surface: Mesh, vertices: int = ..., seed: int = ..., *,
    feature_lines: Literal[True], progress: Progress | None = ..., **parameters: float | bool | str,
) -> tuple[Mesh, Mesh]: ...
@overload
def remesh(
    surface: vtkPolyData | vtkCompositeDataSet | tuple[ArrayLike, ArrayLike], vertices: int = ..., seed: int = ..., *,
    feature_lines: Literal[True], progress: Progress | None = ..., **parameters: float | bool | str,
) -> tuple[vtkPolyData, vtkPolyData]: ...
# fmt: on
def remesh(
    surface: vtkPolyData | vtkCompositeDataSet | Mesh | OfPyVista | tuple[ArrayLike, ArrayLike],
    vertices: int = 20000,
    seed: int = 1,
    *,
    feature_lines: bool = False,
    progress: Progress | None = None,
    **parameters: float | bool | str,
) -> MadeMesh:
    """Make other triangles of a surface: fewer, or more even ones, or more.

    Args:
        surface: Triangles or other polygons, which may be any: a vtkPolyData, as those of PyVista; a
            vtkCompositeDataSet of them, which are one surface; a neuralmesh.Mesh; or a pair of arrays, points
            of shape (N, 3) and triangles of shape (T, 3), numbers of points from 0 on.
        vertices: The number of vertices of the mesh, from 4 to 1000000000. There are more if pieces, handles
            and boundaries need them.
        seed: Seed of the random numbers, from 0 to 2147483647. The same surface and seed give the same bytes.
        feature_lines: Whether there is a second result: the edges that are sharper than feature_angle, as of
            reconstruct().
        progress: A function that is called with the fraction that is done, from 0 to 1. If it returns False,
            the present mesh is the result.
        **parameters: Other properties of vtkNeuralMesh, as of reconstruct(): fidelity, fit_rounds,
            fit_samples, number_of_threads, carry_point_data, output_points_precision and feature_angle.

    Returns:
        The mesh, as of reconstruct(), with the boundaries, pieces, sides and point data of the surface.

    Raises:
        ValueError: The surface has no triangles, or these have no area. A parameter is out of its range, or
            is for clouds only: the message names it.
        TypeError: There is no such parameter.

    Warns:
        RuntimeWarning: For each string of `Warnings`: the surface was cut because it was no manifold,
            triangles intersect, and others. See reconstruct().

    Example:
        >>> smaller = neuralmesh.remesh(mesh, 5000)
        >>> smaller.GetNumberOfPoints()
        5000
    """
    refuse_unknown(remesh, parameters, _KNOWN)
    handed_on: dict[str, Any] = {**parameters, "input_is": "surface"}
    mesh = make_filter(vertices, seed, **handed_on)
    mesh.SetComputeFeatureLines(bool(feature_lines))
    given: Any = surface
    result, _, lines, _ = _world.learn(
        mesh, _world.take_polygons(surface, "surface"), None, progress, given
    )
    require_points(result)
    return (result, lines) if feature_lines else result
