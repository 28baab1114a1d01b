# SPDX-License-Identifier: BSD-3-Clause
"""The subcommand info."""

from __future__ import annotations

import json
import sys
from typing import Any, Sequence

from ..engine.measures import report as report_of
from .names import MESHES, read_mesh
from .parsing import Parser

_KEYS = (
    "vertices", "triangles", "regular_ratio", "valences", "triangle_quality", "closed",
    "edge_manifold", "vertex_manifold", "oriented", "components", "genus", "boundary_loops",
    "boundary_edges", "folded_edges", "non_manifold_edges", "non_manifold_vertices",
    "inconsistent_edges", "surface_area", "volume", "bounding_box_diagonal", "degenerate_triangles",
    "unused_points", "non_finite_points",
)  # fmt: skip
_FOOTER = (
    "regular vertices   have six edges, or four on the boundary\n"
    "triangle quality   twice the radius of the inscribed over that of the circumscribed circle\n"
    "closed             every edge has at least two triangles\n"
    "manifold           an edge has at most two triangles, and those at a vertex are connected\n"
    "oriented           neighbouring triangles have their fronts on the same side\n"
    "components         pieces connected by edges\n"
    "genus              handles of all components, as if the holes were capped\n"
    "boundary loops     outlines and holes\n"
    "folded edges       where the surface turns by more than 150 degrees\n"
    "volume             positive if the normals point outwards\n"
    "Lengths are in units of the file.\n"
    "\nExit status: 0 done, 1 a file cannot be used (the message is on stderr, the other files are\n"
    "still reported), 2 wrong use."
)


def run(arguments: Sequence[str]) -> int:
    """Check whether meshes are sound, and how good they are; the exit status."""
    options = _parser().parse(arguments)
    status = 0
    for path in options.meshes:
        try:
            mesh = read_mesh(path)
            try:
                found = report_of(mesh)
            except ValueError as error:
                raise ValueError(f"{path}: {error}") from None
        except (OSError, ValueError) as error:
            sys.stdout.flush()
            print(f"neuralmesh: {error}", file=sys.stderr)
            status = 1
            continue
        (_print_json if options.json else _print_table)(path, found)
    return status


def _print_json(path: str, found: dict[str, Any]) -> None:
    report = {"file": path, **{key: found[key] for key in _KEYS}}
    print(json.dumps(report, separators=(",", ":"), ensure_ascii=False))


def _print_table(path: str, found: dict[str, Any]) -> None:
    print(path)
    _line("vertices", found["vertices"])
    _line("triangles", found["triangles"])
    _line("regular vertices", f"{100.0 * found['regular_ratio']:.6g} %")
    if found["vertices"] > 0:
        _line("valences", _valences(found))
    _line("triangle quality", f"{found['triangle_quality']:.6g} (mean; 1: equilateral, 0: no area)")
    has_surface = found["components"] > 0
    wrong = f"{found['boundary_edges']} boundary edges" if has_surface else "no triangle of three points"
    _line("closed", _yes_unless(wrong, found["closed"]))
    wrong = (
        f"{found['non_manifold_edges']} edges and {found['non_manifold_vertices']} vertices are not"
    )
    _line("manifold", _yes_unless(wrong, found["edge_manifold"] and found["vertex_manifold"]))
    wrong = f"{found['inconsistent_edges']} edges between opposite sides"
    _line("oriented", _yes_unless(wrong, found["oriented"]))
    _line("components", found["components"])
    _line("genus", _or_not_defined(found["genus"], "d"))
    _line("boundary loops", found["boundary_loops"])
    _line("folded edges", found["folded_edges"])
    _line("area", f"{found['surface_area']:.6g}")
    _line("volume", _or_not_defined(found["volume"], ".6g"))
    _line("diagonal", f"{found['bounding_box_diagonal']:.6g}")
    _line(
        "to be cleaned",
        f"{found['degenerate_triangles']} triangles without area, {found['unused_points']} unused "
        f"points, {found['non_finite_points']} points not finite",
    )


def _line(name: str, value: object) -> None:
    print(f"  {name:18}  {value}")


def _yes_unless(hindrance: str, yes: bool) -> str:
    return "yes" if yes else f"no ({hindrance})"


def _or_not_defined(value: Any, form: str) -> str:
    return "not defined" if value is None else f"{value:{form}}"


def _valences(found: dict[str, Any]) -> str:
    """The valences that are not rare each, the others in one."""
    whole = others = found["vertices"]
    text = ""
    for valence, vertices in found["valences"].items():
        if vertices * 200 >= whole:
            text += f"{valence}: {100.0 * vertices / whole:.2f} %, "
            others -= vertices
    return text + f"others: {100.0 * others / whole:.2f} %"


def _parser() -> Parser:
    result = Parser(
        "info", "Check whether meshes are sound, and how good they are", "MESH...", _FOOTER
    )
    result.add_argument("meshes", nargs="+", metavar="MESH", help=f"Meshes: {MESHES}")
    result.add_flag("--json", "Print a JSON object for each mesh, one per line")
    return result
