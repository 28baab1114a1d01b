# SPDX-License-Identifier: BSD-3-Clause
"""The function info()."""

from __future__ import annotations

from typing import Any

from . import _world
from ._types import Mesh, vtkPolyData

FIGURES = (
    "vertices", "triangles", "regular_ratio", "valences", "triangle_quality", "closed", "edge_manifold",
    "vertex_manifold", "oriented", "components", "genus", "boundary_loops", "boundary_edges",
    "folded_edges", "non_manifold_edges", "non_manifold_vertices", "inconsistent_edges", "surface_area",
    "volume", "bounding_box_diagonal", "degenerate_triangles", "unused_points", "non_finite_points",
)  # fmt: skip


def info(mesh: vtkPolyData | Mesh) -> dict[str, Any]:
    """Check whether a mesh of any program is sound, and how good its triangles are.

    Args:
        mesh: A vtkPolyData with triangles, polygons or strips, of any quality. Polygons are taken as fans
            of triangles; lines and vertices are left out.

    Returns:
        A dict as `neuralmesh info --json` prints it. Integers: `vertices`, points that triangles use;
        `triangles`; `components`, pieces that edges hold together; `genus`, the handles of all of them,
        with the holes taken as capped, None if the mesh is not manifold or cannot be oriented;
        `boundary_loops`; `boundary_edges`; `folded_edges`, where the surface turns by more than 150
        degrees; `non_manifold_edges`; `non_manifold_vertices`; `inconsistent_edges`, with opposite
        sides; `degenerate_triangles`, without area; `unused_points`; `non_finite_points`. Booleans:
        `closed`, `edge_manifold`, `vertex_manifold`, `oriented`. Floats: `regular_ratio`, the share of
        the vertices with six edges, or four on the boundary; `triangle_quality`, the mean of twice the
        radius of the inscribed over that of the circumscribed circle, 1 for equilateral triangles;
        `surface_area`, `volume` and `bounding_box_diagonal` in the unit of the input, the volume
        positive if the normals point outwards, None if the mesh is not closed or not oriented. And
        `valences`, a dict from the number of edges at a vertex to the number of such vertices.

        Without triangles, as of a cloud, the other figures are 0, and `closed` is False; `unused_points`
        and `non_finite_points` count all points.

    Raises:
        ValueError: The mesh is no vtkPolyData, or a triangle refers to a point that is not there.
        RuntimeError: Anything else that VTK finds wrong.

    Example:
        >>> mesh = neuralmesh.reconstruct(points)
        >>> neuralmesh.info(mesh)["closed"]
        True
    """
    report = _world.report(_world.take_surface(mesh, "mesh"))
    return {name: report.get(name) for name in FIGURES}
