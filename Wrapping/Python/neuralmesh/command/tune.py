# SPDX-License-Identifier: BSD-3-Clause
"""The subcommand tune."""

from __future__ import annotations

import json
from typing import Any, Sequence

from .. import _engine
from .._arrays import as_points
from .names import POINTS, read_points
from .parsing import Parser, described

_FOOTER = (
    "Takes some seconds for a cloud of any size, and writes nothing.\n"
    "reconstruct --automatic does the same before it learns.\n"
    "For example: neuralmesh tune scan.ply --vertices 20000\n"
    "Exit status: 0 done, 1 failed (the message is on stderr), 2 wrong use."
)


def run(arguments: Sequence[str]) -> int:
    """Choose the parameters for a point cloud; the exit status."""
    options = _parser().parse(arguments)
    points = read_points(options.input).points
    parameters = {
        "NumberOfVertices": options.vertices,
        "Seed": options.seed,
        "Boundaries": int(options.close),
    }
    try:
        tuning = _engine.tune([as_points(points)], parameters, options.threads, None)
    except ValueError as error:
        raise ValueError(f"{options.input}: {error}") from None
    if options.json:
        chosen = {choice["parameter"]: choice["value"] for choice in tuning["choices"]}
        report = {
            "file": options.input,
            "vertices": options.vertices,
            "chosen": chosen,
            "trials": tuning["trials"],
            "reasons": tuning["reasons"],
        }
        print(json.dumps(report, indent=2, ensure_ascii=False))
    else:
        _print(options, tuning)
    return 0


def _print(options: Any, tuning: dict[str, Any]) -> None:
    assignments = ""
    for choice in tuning["choices"]:
        name, value, before = choice["parameter"], _text(choice["value"]), _text(choice["before"])
        print(f"{name:17} {value} instead of {before}")
        assignments += f" --fidelity {value}" if name == "Fidelity" else f" --set {name}={value}"
    if not tuning["choices"]:
        print("nothing better than the defaults was found")
    for reason in tuning["reasons"]:
        print(f"  {reason}")
    boundaries = " --boundaries close" if options.close else ""
    print(
        f"neuralmesh reconstruct {options.input} OUTPUT --vertices {options.vertices}{boundaries}"
        f"{assignments}"
    )


def _text(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:.3g}"


def _parser() -> Parser:
    result = Parser(
        "tune", "Choose the parameters for a point cloud, with reasons", "INPUT", _FOOTER
    )
    result.add_argument("input", metavar="INPUT", help=POINTS)
    result.add_number(
        "--vertices", "NumberOfVertices",
        f"Vertices of the mesh, {described('NumberOfVertices')}", "N",
    )  # fmt: skip
    result.add_number("--seed", "Seed", f"Seed of the random numbers, {described('Seed')}", "N")
    result.add_flag("--close", "The mesh shall be watertight, although the scan has gaps")
    result.add_number(
        "--threads", "NumberOfThreads",
        f"Largest number of threads, {described('NumberOfThreads')}; 0: as many as the process may run at once", "N",
    )  # fmt: skip
    result.add_flag("--json", "Print JSON")
    return result
