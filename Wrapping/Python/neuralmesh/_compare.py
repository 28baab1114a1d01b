# SPDX-License-Identifier: BSD-3-Clause
"""The function compare()."""

from __future__ import annotations

from . import _world
from ._parameters import assign, snake_case
from ._types import Mesh, vtkPolyData

_DIRECTIONS = ("reference_to_result", "result_to_reference")


def compare(
    reference: vtkPolyData | Mesh,
    result: vtkPolyData | Mesh,
    samples: int = 200000,
    seed: int = 1,
) -> dict[str, dict[str, float]]:
    """Measure how far a mesh is from a reference, over the surfaces and both ways.

    Points are drawn evenly over the area of each surface. Their distances to the nearest points of the
    other surface are measured. The surfaces are not aligned. For the distances of single points, use
    vtkNeuralMeshComparison.

    Args:
        reference: The surface as it should be: a vtkPolyData with triangles, polygons or strips.
        result: The surface in question, in the same unit of length.
        samples: The number of points drawn on each surface, from 1000 to 100000000.
        seed: Seed of the random numbers, from 0 to 2147483647. The same surfaces and seed give the
            same figures.

    Returns:
        A dict with the keys `reference_to_result`, which shows what the result misses, and
        `result_to_reference`, which shows what is superfluous in it. Each is a dict of floats:
        `mean`, `rms`, `percentile_99` and `maximum` of the distances, in the unit of the input; the
        same with `_percent` behind, in percent of the diagonal of the bounding box of the
        reference; `normal_angle`, the mean angle between the normals of both surfaces, in degrees
        from 0 to 90; `normal_consistency`, the mean of |n . n'| of these normals (Mescheder et al.
        2019); and, of the sharp edges of the surface from which the direction sets out, where it
        turns by more than 30 degrees, `edge_length` and the mean distances `edge_mean` from the
        sharp edges and `edge_to_surface` from the whole of the other surface, these also with
        `_percent`.

        The key `both_ways` has a dict of the figures of both directions together: `chamfer`, half
        of the sum of both means (Mescheder et al. 2019); `chamfer_squared`, the sum of both mean
        squares (Fan et al. 2017); `precision_0_1`, `recall_0_1` and `f_score_0_1`, the parts, 0 to
        1, of the result and of the reference that are nearer to the other surface than 0.1 % of
        the diagonal, and their harmonic mean (Knapitsch et al. 2017), and the same with `_0_5` at
        0.5 %; `hausdorff`, the larger maximum; `normal_angle` and `normal_consistency`, the means
        of both directions; `edge_chamfer`, half of the sum of both `edge_mean` (after Chen and
        Zhang 2021). `chamfer`, `hausdorff` and `edge_chamfer` are there with `_percent`, too.

        Distances of edges are NaN where there are none: `edge_to_surface` if the first surface has
        no sharp edges, `edge_mean` and `edge_chamfer` if one of both has none.

    Raises:
        ValueError: A parameter is out of its range, which the message names; or a surface is no
            vtkPolyData, or has no triangle with an area.
        RuntimeError: Anything else that VTK finds wrong.
        KeyboardInterrupt: Ctrl-C was pressed.

    Warns:
        RuntimeWarning: What VTK warns of.

    Example:
        >>> figures = neuralmesh.compare(original, neuralmesh.reconstruct(points))
        >>> figures["reference_to_result"]["rms_percent"]
        0.0361
    """
    comparison = _world.NeuralMeshComparison()
    assign(comparison, "number_of_samples", samples, shown_name="samples")
    assign(comparison, "seed", seed)
    surfaces = [
        _world.take_surface(surface, name)
        for name, surface in (("reference", reference), ("result", result))
    ]
    columns, both_ways = _world.compare(comparison, *surfaces)
    if not both_ways:
        raise ValueError("reference and result are empty")
    figures = {
        direction: {snake_case(name): values[row] for name, values in columns.items()}
        for row, direction in enumerate(_DIRECTIONS)
    }
    figures["both_ways"] = {snake_case(name): value for name, value in both_ways.items()}
    return figures
