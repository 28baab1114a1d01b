# SPDX-License-Identifier: BSD-3-Clause
"""The function remesh()."""

from __future__ import annotations

from typing import Any

from . import _world
from ._parameters import refuse_unknown
from ._reconstruct import PARAMETERS, make_filter, require_points
from ._types import ArrayLike, MadeMesh, Mesh, Progress, vtkCompositeDataSet, vtkPolyData

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


def remesh(
    surface: vtkPolyData | vtkCompositeDataSet | Mesh | tuple[ArrayLike, ArrayLike],
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
        vertices: The number of vertices of the mesh, from 4 to 1000000000. Where pieces, handles and
            boundaries need more, there are more.
        seed: Seed of the random numbers, from 0 to 2147483647. The same surface and seed give the same bytes.
        feature_lines: Whether the edges that are sharper than feature_angle are found: then the result is the
            mesh and, as a second one, these lines, as reconstruct() gives them.
        progress: A function that is called now and then with the fraction that is done, from 0 to 1. If it
            returns False, the mesh as it is then is the result.
        **parameters: Other properties of vtkNeuralMesh, as of reconstruct(). Of use are fidelity, fit_rounds,
            fit_samples, number_of_threads, carry_point_data, output_points_precision and feature_angle.

    Returns:
        The mesh, as reconstruct() gives it: its boundaries, pieces and sides are those of the surface, and it has
        the point data of that.

    Raises:
        ValueError: The surface has no triangles, or these have no area, or a parameter is out of its range, or
            is one that a surface excludes: the message names it.
        TypeError: There is no such parameter.

    Warns:
        RuntimeWarning: What must be known of the mesh: that the surface was cut, as it was no manifold, that
            triangles intersect, and so on. The strings of `Warnings`.

    Example:
        >>> smaller = neuralmesh.remesh(mesh, 5000)
        >>> smaller.GetNumberOfPoints()
        5000
    """
    refuse_unknown(remesh, parameters, _KNOWN)
    mesh = make_filter(vertices, seed, input_is="surface", **parameters)
    mesh.SetComputeFeatureLines(bool(feature_lines))
    given: Any = surface
    result, _, lines, _ = _world.learn(
        mesh, _world.take_polygons(surface, "surface"), None, progress, given
    )
    require_points(result)
    return (result, lines) if feature_lines else result
