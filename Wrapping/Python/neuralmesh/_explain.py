# SPDX-License-Identifier: BSD-3-Clause
"""The function explain()."""

from __future__ import annotations

from typing import Any, overload

from . import _world
from ._parameters import assign
from ._reconstruct import require_points
from ._types import (
    ArrayLike,
    Mesh,
    OfPyVista,
    Progress,
    PyVistaMesh,
    vtkCompositeDataSet,
    vtkPointSet,
    vtkPolyData,
)


# fmt: off
@overload
def explain(
    points: OfPyVista, mesh: vtkPolyData | Mesh, smallest_piece: float = ..., *, progress: Progress | None = ...,
) -> PyVistaMesh: ...
@overload
def explain(
    points: Mesh, mesh: vtkPolyData | Mesh, smallest_piece: float = ..., *, progress: Progress | None = ...,
) -> Mesh: ...
@overload
def explain(
    points: ArrayLike | vtkPointSet | vtkCompositeDataSet, mesh: vtkPolyData | Mesh, smallest_piece: float = ...,
    *, progress: Progress | None = ...,
) -> vtkPolyData: ...
# fmt: on
def explain(
    points: ArrayLike | vtkPointSet | vtkCompositeDataSet | Mesh | OfPyVista,
    mesh: vtkPolyData | Mesh,
    smallest_piece: float = 0.0005,
    *,
    progress: Progress | None = None,
) -> Any:
    """Distance from a mesh for each point of a cloud, and the reason why the mesh leaves it out.

    Any program may have made the mesh. A point is away from it if its distance exceeds two limits: three
    times its mean distance to its six nearest neighbours, and eight times the median distance of all.

    Args:
        points: The cloud, as that of reconstruct(), but no path.
        mesh: Triangles, polygons or strips in the coordinates of the points.
        smallest_piece: Part of all points below which points that are away are a small piece; from 0 to
            1.
        progress: As that of reconstruct(). If it returns False, the result has no points.

    Returns:
        vtkPolyData with the points in their order, and the point data `Distance`, in the unit of the
        input, NaN for points that are not finite; and `Reason`: 0 explained, 1 outlier, 2 small piece,
        3 unreachable, 4 dropped. The field data `ReasonNames` has these names. Further field
        data: `OutlierPoints`, `SmallPiecePoints`, `UnreachablePoints`, `UnexplainedPoints`,
        `UnexplainedShare`, `MissedPieceCenters` and `MissedPiecePoints`.

    Raises:
        ValueError: smallest_piece is out of its range; or there are no points, none that is finite, or
            none that differs from the others; or the mesh is no vtkPolyData, or has no triangle with an
            area.
        RuntimeError: Anything else that VTK finds wrong.
        KeyboardInterrupt: Ctrl-C was pressed.

    Example:
        >>> explained = neuralmesh.explain(points, mesh)
        >>> explained.GetFieldData().GetArray("UnexplainedPoints").GetValue(0)
        0
    """
    explanation = _world.NeuralMeshExplanation()
    assign(explanation, "smallest_piece", smallest_piece)
    surface = _world.take_surface(mesh, "mesh")
    cloud = _world.take_points(points)
    is_ended = False

    def watch(fraction: float) -> bool | None:
        nonlocal is_ended
        goes_on = progress(fraction) if progress else None
        is_ended = is_ended or goes_on is False
        return goes_on

    result = _world.explain(explanation, cloud, surface, watch, points)
    if not is_ended:
        require_points(result)
    return result
