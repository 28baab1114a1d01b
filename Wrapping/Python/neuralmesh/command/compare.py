# SPDX-License-Identifier: BSD-3-Clause
"""The subcommand compare."""

from __future__ import annotations

import json
from typing import Any, Sequence

from ..engine.measures import Comparison, NeuralMeshComparison
from .names import MESHES, read_mesh
from .parsing import Parser, number_from

_SAMPLES = NeuralMeshComparison.PROPERTIES["NumberOfSamples"]
_SEED = NeuralMeshComparison.PROPERTIES["Seed"]
_FIGURES = {
    "mean": "Mean", "rms": "RMS", "percentile_99": "Percentile99", "maximum": "Maximum",
    "mean_percent": "MeanPercent", "rms_percent": "RMSPercent",
    "percentile_99_percent": "Percentile99Percent", "maximum_percent": "MaximumPercent",
    "normal_angle": "NormalAngle",
}  # fmt: skip
_LENGTHS = ("Mean", "RMS", "Percentile99", "Maximum")
_FOOTER = (
    "Points are drawn evenly over the area of both surfaces. Of each, the distance to the nearest\n"
    "point of the other surface is taken: from the result to the reference it is large where the\n"
    "result has something that is not there, from the reference to the result where it misses\n"
    "something. Printed are mean, root mean square, the distance that 99 % do not exceed, and the\n"
    "maximum, in units of the files and in percent of the diagonal of the reference's bounding\n"
    "box; and the mean angle, 0 to 90 degrees, between the normals at a point and at its nearest\n"
    "point. Nothing is aligned.\n"
    "\nExit status: 0 done, 1 failed (the message is on stderr), 2 wrong use."
)


def run(arguments: Sequence[str]) -> int:
    """Tell how far a mesh is from a reference; the exit status."""
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
        {name: found.table[column][row] for name, column in _FIGURES.items()} for row in range(2)
    ]
    hausdorff = max(found.table["Maximum"])
    report = {
        "reference": options.reference,
        "result": options.result,
        "samples": options.samples,
        "seed": options.seed,
        "reference_diagonal": found.diagonal,
        "reference_to_result": rows[0],
        "result_to_reference": rows[1],
        "hausdorff": hausdorff,
        "hausdorff_percent": 100.0 * hausdorff / found.diagonal,
        "normal_angle": sum(found.table["NormalAngle"]) / 2.0,
    }
    print(json.dumps(report, separators=(",", ":"), ensure_ascii=False))


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
    hausdorff = max(found.table["Maximum"])
    print(
        f"\nHausdorff distance {hausdorff:.5g} ({100.0 * hausdorff / found.diagonal:.4f} %), mean angle "
        f"of the normals {sum(found.table['NormalAngle']) / 2.0:.2f} deg"
    )


def _parser() -> Parser:
    result = Parser(
        "compare", "Tell how far a mesh is from a reference", "REFERENCE RESULT", _FOOTER
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
    result.add_flag("--json", "Print a JSON object in place of the table")
    return result
