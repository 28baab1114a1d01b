# SPDX-License-Identifier: BSD-3-Clause
"""The subcommand explain."""

from __future__ import annotations

from typing import Any, Sequence

from ..engine import files
from ..engine.cloud import as_cloud
from ..engine.measures import NeuralMeshExplanation
from .names import (
    MESHES, POINTS, NamedFile, read_mesh, read_points, require_distinct, require_explanation,
)  # fmt: skip
from .parsing import Parser, number_from, plain
from .run_report import print_reasons

_MOST_PIECES = 10  # more are not printed
_PIECE = NeuralMeshExplanation.PROPERTIES["SmallestPiece"]
_FOOTER = (
    "A point is away from the mesh if its distance exceeds two limits: three times its mean\n"
    "distance to its six nearest neighbours, and eight times the median distance of all points.\n"
    "Reason is 0 (explained: not away), 1 (outlier: away, and apart from other points), 2 (small\n"
    "piece: away, with few others), 3 (unreachable: away, with many others) or 4 (dropped: no\n"
    "finite coordinates, or one of very many points at one place).\n"
    "\nExit status: 0 done, 1 failed (the message is on stderr), 2 wrong use."
)


def run(arguments: Sequence[str]) -> int:
    """Measure the distance of each point from a mesh, and give the reason; the exit status."""
    options = _parser().parse(arguments)
    require_distinct(
        [
            NamedFile("INPUT", options.input),
            NamedFile("MESH", options.mesh),
            NamedFile("OUTPUT", options.output, True),
        ]
    )
    require_explanation("OUTPUT", options.output)
    points, mesh = read_points(options.input), read_mesh(options.mesh)
    if len(points.points) == 0:
        raise ValueError(f"{options.input}: there are no points in it")
    explanation: Any = NeuralMeshExplanation()
    explanation.SetSmallestPiece(options.keep_pieces)
    try:
        explained = explanation.explain(as_cloud(points), mesh)
    except ValueError as error:
        raise ValueError(f"{options.input} and {options.mesh}: {error}") from None
    files.write_mesh(explained, options.output)
    print(f"points     {len(explained.points)}")
    print_reasons(explained.field_data)
    _print_pieces(explained.field_data)
    return 0


def _print_pieces(fields: dict[str, Any]) -> None:
    centers, counts = fields["MissedPieceCenters"], fields["MissedPiecePoints"]
    for (x, y, z), count in list(zip(centers, counts))[:_MOST_PIECES]:
        print(f"missed     {count} points around ({x:.10g}, {y:.10g}, {z:.10g})")
    if len(centers) > _MOST_PIECES:
        print(f"missed     ... in {len(centers)} places")


def _parser() -> Parser:
    result = Parser(
        "explain",
        "Measure the distance of each point from a mesh, and give the reason",
        "INPUT MESH OUTPUT",
        _FOOTER,
    )
    result.add_argument("input", metavar="INPUT", help=POINTS)
    result.add_argument(
        "mesh", metavar="MESH", help=f"A mesh of any program, in the same coordinates: {MESHES}"
    )
    result.add_argument(
        "output", metavar="OUTPUT", help="The points with Distance and Reason: .vtp, by VTK"
    )
    result.add_argument(
        "--keep-pieces",
        type=number_from(_PIECE.low, _PIECE.high, False),
        default=_PIECE.default,
        metavar="PART",
        help="Part of all points below which missed points are a small piece, "
        f"{plain(_PIECE.low)} to {plain(_PIECE.high)} (default {plain(_PIECE.default)})",
    )
    return result
