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

    Points are drawn evenly over the area of each surface, and the distance of each to the nearest
    point of the other surface is taken. Nothing is aligned. The distances of single points, for
    colouring, are the outputs of vtkNeuralMeshComparison.

    Args:
        reference: The surface as it should be: a vtkPolyData with triangles, polygons or strips.
        result: The surface in question, in the same unit of length.
        samples: The number of points drawn on each surface, from 1000 to 100000000.
        seed: Seed of the random numbers, from 0 to 2147483647. The same surfaces and seed give the
            same figures.

    Returns:
        A dict with the keys `reference_to_result`, which tells of what the result misses, and
        `result_to_reference`, which tells of what it has too much. Each is a dict of floats:
        `mean`, `rms`, `percentile_99` and `maximum` of the distances, in the unit of the input; the
        same with `_percent` behind, in percent of the diagonal of the bounding box of the
        reference; and `normal_angle`, the mean angle between the normals of both surfaces, in
        degrees from 0 to 90.

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
    columns = _world.compare(comparison, *surfaces)
    if not any(columns.values()):
        raise ValueError("reference and result are empty")
    return {
        direction: {snake_case(name): values[row] for name, values in columns.items()}
        for row, direction in enumerate(_DIRECTIONS)
    }
