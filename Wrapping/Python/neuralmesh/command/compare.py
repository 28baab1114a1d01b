# SPDX-License-Identifier: BSD-3-Clause
"""The subcommand compare."""

from __future__ import annotations

import json
import math
from typing import Any, Sequence

from .._parameters import snake_case
from ..engine.measures import Comparison, NeuralMeshComparison
from .names import MESHES, read_mesh
from .parsing import Parser, number_from

_SAMPLES = NeuralMeshComparison.PROPERTIES["NumberOfSamples"]
_SEED = NeuralMeshComparison.PROPERTIES["Seed"]
_FIGURES = {
    "mean": "Mean", "rms": "RMS", "percentile_99": "Percentile99", "maximum": "Maximum",
    "mean_percent": "MeanPercent", "rms_percent": "RMSPercent",
    "percentile_99_percent": "Percentile99Percent", "maximum_percent": "MaximumPercent",
    "normal_angle": "NormalAngle", "normal_consistency": "NormalConsistency",
    "edge_mean": "EdgeMean", "edge_to_surface": "EdgeToSurface",
    "edge_mean_percent": "EdgeMeanPercent", "edge_to_surface_percent": "EdgeToSurfacePercent",
    "edge_length": "EdgeLength",
}  # fmt: skip
_LENGTHS = ("Mean", "RMS", "Percentile99", "Maximum")
_FOOTER = (
    "Points are drawn evenly over the area of both surfaces, and their distances to the nearest\n"
    "points of the other surface are measured. Distances from the result to the reference show\n"
    "what is superfluous in the result, those from the reference to the result show what it\n"
    "misses. The figures are mean, root mean square, the distance that 99 % do not exceed, and the\n"
    "maximum, in units of the files and in percent of the diagonal of the bounding box of the\n"
    "reference. The mean angle, 0 to 90 degrees, is that between the normals at a point and at its\n"
    "nearest point. The surfaces are not aligned.\n"
    "\n"
    "At a sharp edge a surface turns by more than 30 degrees. The figures are the length of these\n"
    "edges, and the mean distances of points on them from the sharp edges of the other surface and\n"
    "from the whole of it. They are nan without sharp edges.\n"
    "\n"
    "Figures of both directions together:\n"
    "  F-score             precision P and recall R are the parts of the result and of the\n"
    "                      reference that are nearer to the other surface than 0.1 or 0.5 %\n"
    "                      of the diagonal, the F-score is 2 P R / (P + R)\n"
    "                      (Knapitsch et al. 2017)\n"
    "  Chamfer distance    half of the sum of both means (Mescheder et al. 2019); squared: the\n"
    "                      sum of both mean squares (Fan et al. 2017); of edges: half of the\n"
    "                      sum of both means between edges (after Chen and Zhang 2021)\n"
    "  normal consistency  the mean of |n . n'| of the normals, 0 to 1 (Mescheder et al. 2019)\n"
    "  Hausdorff distance  the larger maximum\n"
    "\nExit status: 0 done, 1 failed (the message is on stderr), 2 wrong use."
)


def run(arguments: Sequence[str]) -> int:
    """Measure the distance of a mesh from a reference; the exit status."""
    options = _parser().parse(arguments)
    reference, result = read_mesh(options.reference), read_mesh(options.result)
    comparison: Any = NeuralMeshComparison()
    comparison.SetNumberOfSamples(options.samples)
    comparison.SetSeed(options.seed)
    try:
        found = comparison.compare(reference, result)
    except ValueError as error:
        raise ValueError(f"{options.reference} and {options.result}: {error}") from None
    (_print_json if options.json else _print_table)(options, found)
    return 0


def _print_json(options: Any, found: Comparison) -> None:
    rows = [
        {name: _or_null(found.table[column][row]) for name, column in _FIGURES.items()}
        for row in range(2)
    ]
    report = {
        "reference": options.reference,
        "result": options.result,
        "samples": options.samples,
        "seed": options.seed,
        "reference_diagonal": found.diagonal,
        "reference_to_result": rows[0],
        "result_to_reference": rows[1],
        **{snake_case(name): _or_null(figure) for name, figure in found.both_ways.items()},
    }
    print(json.dumps(report, separators=(",", ":"), ensure_ascii=False))


def _or_null(figure: float) -> float | None:
    """JSON has no word for what is no number."""
    return None if math.isnan(figure) else figure


def _print_table(options: Any, found: Comparison) -> None:
    print(f"reference  {options.reference}\nresult     {options.result}")
    print(f"diagonal   {found.diagonal:.6g}, of the reference\n")
    columns = "  ".join(f"{name:>11}" for name in ("mean", "RMS", "99 %", "maximum"))
    print(f"{'distance':22}  {columns}  {'normals':>12}")
    for row, title in enumerate(("reference to result", "result to reference")):
        figures = [found.table[name][row] for name in _LENGTHS]
        percent = 100.0 / found.diagonal
        lengths = "".join(f"  {figure:11.5g}" for figure in figures)
        print(f"{title:22}{lengths}  {found.table['NormalAngle'][row]:8.2f} deg")
        print(" " * 22 + "".join(f"  {percent * figure:9.4f} %" for figure in figures))
    _print_edges(found)
    _print_both_ways(found)


def _print_edges(found: Comparison) -> None:
    if not any(found.table["EdgeLength"]):
        print(f"\n{'sharp edges':22}  {'none':>11}")
        return
    columns = "  ".join(f"{name:>11}" for name in ("length", "to edges", "to surface"))
    print(f"\n{'sharp edges':22}  {columns}")
    for row, title in enumerate(("reference to result", "result to reference")):
        figures = [found.table[name][row] for name in ("EdgeLength", "EdgeMean", "EdgeToSurface")]
        print(f"{title:22}" + "".join(f"  {figure:11.5g}" for figure in figures))
        percent = [100.0 / found.diagonal * figure for figure in figures[1:]]
        print(" " * 35 + "".join(f"  {figure:9.4f} %" for figure in percent))


def _print_both_ways(found: Comparison) -> None:
    both = found.both_ways
    print()
    for name in ("0.1", "0.5"):
        precision, recall, score = (
            both[figure + name.replace(".", "_")] for figure in ("Precision", "Recall", "FScore")
        )
        print(
            f"F-score at {name} %: {score:.4f} (precision {precision:.4f}, recall {recall:.4f})"
        )
    print(
        f"Chamfer distance {both['Chamfer']:.5g} ({both['ChamferPercent']:.4f} %), squared "
        f"{both['ChamferSquared']:.5g}, of sharp edges {both['EdgeChamfer']:.5g} "
        f"({both['EdgeChamferPercent']:.4f} %)"
    )
    print(f"Normal consistency {both['NormalConsistency']:.4f}")
    print(
        f"Hausdorff distance {both['Hausdorff']:.5g} ({both['HausdorffPercent']:.4f} %), mean angle "
        f"of the normals {both['NormalAngle']:.2f} deg"
    )


def _parser() -> Parser:
    result = Parser(
        "compare", "Measure the distance of a mesh from a reference", "REFERENCE RESULT", _FOOTER
    )
    result.add_argument("reference", metavar="REFERENCE", help=f"The true surface: {MESHES}")
    result.add_argument(
        "result", metavar="RESULT", help="The mesh to judge, in the same coordinates"
    )
    result.add_argument(
        "--samples",
        type=number_from(_SAMPLES.low, _SAMPLES.high, True),
        default=_SAMPLES.default,
        metavar="N",
        help=f"Points drawn on each surface, {_SAMPLES.low} to {_SAMPLES.high} "
        f"(default {_SAMPLES.default})",
    )
    result.add_argument(
        "--seed",
        type=number_from(_SEED.low, _SEED.high, True),
        default=_SEED.default,
        metavar="N",
        help=f"Seed of the random numbers, from 0 on (default {_SEED.default})",
    )
    result.add_flag("--json", "Print a JSON object instead of the table")
    return result
