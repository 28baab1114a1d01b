# SPDX-License-Identifier: BSD-3-Clause
"""The options of the subcommand reconstruct."""

from __future__ import annotations

import argparse
import math
from typing import Sequence

from . import settings
from .names import MESHES, OUTPUTS, POINTS
from .parsing import (
    Parser, described, described_words, number_from, plain, property_of, range_text, words_of,
)  # fmt: skip

_METHODS = {
    "basic": "all samples move vertices alike",
    "noise": "distant samples move vertices less",
    "normal": "dense where the surface bends, sparse where it is flat",
}
_PRESETS = {
    "default": "the values with the best measured results",
    "thesis": "the values of Saleem's thesis, without later additions",
}
_ORDERS = {"exact": "counters", "list": "the activity list"}
_BOUNDARIES = {
    "keep": "the mesh ends where the points end",
    "close": "the mesh is watertight, unless it is an almost flat sheet",
}
_FIDELITIES = {
    "draft": "only the first rounds of the fit",
    "default": "also creases, tips and noise",
    "high": "more rounds, until they gain almost nothing",
}
_AUTO = "auto"
_MEASURES = {
    "rms": "the root of the mean square",
    "99": "the distance that 99 %% do not exceed",
    "largest": "",
}
_TOPOLOGIES = {
    "off": "the surface keeps the topology of its start",
    "on": "learn handles and openings",
}
_FOOTER = (
    "For example: neuralmesh reconstruct scan.ply mesh.ply --vertices 20000\n"
    "Ctrl-C, SIGTERM or SIGHUP end the learning and write the mesh learnt so far.\n"
    "Each warning about a mesh ends with a tag in brackets: "
    "a heading of Documentation/Guide/Failures.md.\n"
    "Exit status: 0 done, 1 failed (the message is on stderr), 2 wrong use, 3 done with a warning\n"
    "and --strict, 130 after Ctrl-C, 143 after SIGTERM, 129 after SIGHUP."
)


def _levels_of(text: str) -> list[int]:
    allowed = property_of("NumberOfVertices")
    convert = number_from(allowed.low, allowed.high, True)
    return [convert(number) for number in text.split(",")]


def _vertices_of(text: str) -> int:
    if text == _AUTO:
        return 0
    allowed = property_of("NumberOfVertices")
    try:
        return int(number_from(allowed.low, allowed.high, True)(text))
    except argparse.ArgumentTypeError as error:
        raise argparse.ArgumentTypeError(f"{error}, nor {_AUTO}") from None


def _tolerance_of(text: str) -> tuple[float, bool]:
    """A length, and whether it is in percent."""
    is_percent = text.endswith("%")
    try:
        length = float(text.removesuffix("%"))
    except ValueError:
        length = math.nan
    largest = property_of("Tolerance").high
    if not (0 < length <= largest):
        raise argparse.ArgumentTypeError(
            f"{text} is no length above 0, to {plain(largest)}, with % behind it or without"
        )
    return length, is_percent


class _ReconstructParser(Parser):
    def parse(self, arguments: Sequence[str]) -> argparse.Namespace:
        options = super().parse(arguments)
        if len(options.files) < 2:
            self.error(
                f"the following arguments are required: {'OUTPUT' if options.files else 'INPUT'}"
            )
        if options.initial and options.ensemble:
            self.error("--initial excludes --ensemble")
        if options.views and options.viewpoint:
            self.error("--views excludes --viewpoint")
        if options.levels is not None:
            if options.vertices is not None:
                self.error("--levels excludes --vertices")
            if options.tolerance is not None:
                self.error("--levels excludes --tolerance")
            options.vertices = options.levels[-1]
        elif options.vertices is None:
            options.vertices = property_of("NumberOfVertices").default
        elif options.tolerance is not None:
            self.error("--vertices excludes --tolerance")
        if options.tolerance_of is None:
            options.tolerance_of = int(property_of("ToleranceMeasure").default)
        elif options.tolerance is None:
            self.error("--tolerance-of requires --tolerance")
        if options.checkpoint_interval is None:
            options.checkpoint_interval = property_of("CheckpointInterval").default
        elif not options.checkpoint:
            self.error("--checkpoint-interval requires --checkpoint")
        return options


def parser() -> Parser:
    """What the subcommand takes."""
    members = property_of("NumberOfMembers")
    result = _ReconstructParser(
        "reconstruct",
        "Make a triangle mesh from a point cloud",
        "INPUT... OUTPUT",
        f"Parameters of learning, for --set:\n{settings.table()}\n{_FOOTER}",
    )
    result.add_argument(
        "files",
        nargs="*",
        metavar="INPUT... OUTPUT",
        help=f"{POINTS}; several files are one cloud. The last name is the mesh: {' '.join(OUTPUTS)} "
        "(.vtp .vtk by VTK). It must differ from all other files",
    )
    result.add_argument(
        "--vertices",
        type=_vertices_of,
        metavar=f"N|{_AUTO}",
        help=f"Vertices of the mesh, {described('NumberOfVertices')}; {_AUTO}: as many as the points support",
    )
    result.add_argument(
        "--levels",
        type=_levels_of,
        metavar="N1,N2,...",
        help="Levels of detail: meshes of N1, N2, ... vertices in one run, instead of --vertices. The "
        "largest is OUTPUT. The others are beside it, such as OUTPUT_1000.vtp",
    )
    result.add_argument(
        "--tolerance",
        type=_tolerance_of,
        metavar="LENGTH[%]",
        help="Choose the fewest vertices with this distance to held-out points, without their noise. In "
        "units of INPUT, or with %% in percent of the diagonal of its bounding box",
    )
    result.add_choice(
        "--tolerance-of", list(_MEASURES), None,
        f"Which distance --tolerance limits; {described_words(_MEASURES, 'rms')}",
    )  # fmt: skip
    result.add_flag(
        "--remesh",
        "INPUT is a surface of triangles or other polygons: remesh it with the number of "
        f"--vertices; {MESHES}",
    )
    result.add_number(
        "--seed", "Seed",
        f"Seed of the random numbers, {described('Seed')}: the same seed, the same mesh", "N",
    )  # fmt: skip
    result.add_text("--initial", f"Start from the triangles of this file: {MESHES}", "FILE")
    result.add_argument(
        "--ensemble",
        type=number_from(members.low, members.high, True),
        default=0,
        metavar="MEMBERS",
        help=f"Number of coarse meshes whose average is the start, {range_text(members)}, "
        f"{plain(members.default)} is usual: makes handles more reliable",
    )
    for option, name, texts, before in (
        ("--method", "Variant", _METHODS, ""),
        ("--preset", "", _PRESETS, ""),
        ("--order", "Order", _ORDERS, "How the program measures where to grow; "),
    ):
        default = int(property_of(name).default) if name else 0
        words = list(texts)
        result.add_choice(option, words, default, before + described_words(texts, words[default]))
    result.add_text(
        "--weights",
        "Weight the points by this point array of INPUT: weights from 0 on. Only ratios count",
        "ARRAY",
    )
    _add_sides(result)
    jumps = words_of("Jump")
    result.add_text(
        "--jump",
        "With --order list: how far winners jump. FRACTION of the vertices (default "
        f"{settings.shown(property_of('JumpFraction').default, property_of('JumpFraction'))}) times 1 "
        "(constant) or the change by the move over the mean change. Default "
        f"{jumps[int(property_of('Jump').default)]}",
        f"{'|'.join(jumps)}[=FRACTION]",
    )
    result.add_choice(
        "--topology", list(_TOPOLOGIES), None,
        described_words(_TOPOLOGIES, "off") + "; with --ensemble on by default",
    )  # fmt: skip
    result.add_text(
        "--shift",
        "Subtract this from the coordinates of OUTPUT, and store it there. auto: a round vector if they are "
        "too large for floats",
        "auto|X,Y,Z",
    )
    result.add_choice(
        "--boundaries", list(_BOUNDARIES), int(property_of("Boundaries").default),
        f"Gaps in the scan; {described_words(_BOUNDARIES, 'keep')}",
    )  # fmt: skip
    _add_run(result)
    return result


def _add_sides(result: Parser) -> None:
    result.add_text(
        "--viewpoint",
        "Position of the scanner: the surface looks there. May be given several times, and replaces the "
        "viewpoints of INPUT. As many as INPUTs: one for each",
        "X,Y,Z", action="append", default=[],
    )  # fmt: skip
    result.add_text(
        "--views",
        "The positions of the scanner, one for each view, as the points of this file. Excludes --viewpoint",
        "FILE",
    )
    result.add_text(
        "--view-array",
        "With --views: the point array of INPUT with the number of the view of each point, from 0 on. "
        "Default: View. Without it, a view sees what nothing hides",
        "ARRAY",
    )
    result.add_text(
        "--normals",
        "The point array of INPUT with the normals; off: ignore normals. Default: the active ones, or "
        "Normals (nx, ny, nz of a .ply)",
        "ARRAY|off",
    )
    result.add_text(
        "--up", "The up direction: most of an open surface looks there. --viewpoint is more reliable", "X,Y,Z"
    )


def _add_run(result: Parser) -> None:
    result.add_choice(
        "--fidelity", list(_FIDELITIES), int(property_of("Fidelity").default),
        "How much work brings the mesh close to the points; "
        + described_words(_FIDELITIES, "default"),
    )  # fmt: skip
    result.add_number(
        "--close-holes-below", "CloseHolesBelow",
        "Fill holes with an outline, the sum of the edges, shorter than LENGTH, in units of INPUT; "
        + described("CloseHolesBelow"), "LENGTH",
    )  # fmt: skip
    result.add_number(
        "--keep-pieces", "KeepPieces",
        f"Drop pieces with less than this part of the area of the surface, {described('KeepPieces')}; "
        "0 keeps all", "PART",
    )  # fmt: skip
    result.add_text(
        "--set",
        "Set a parameter of learning, see below. May be given several times",
        "NAME=VALUE", action="append", default=[],
    )  # fmt: skip
    result.add_flag(
        "--automatic",
        "Choose Fidelity and FitSmoothness for INPUT by short runs of some seconds",
    )
    result.add_flag(
        "--features",
        "Add FeatureStrength, which is high at edges and corners. OUTPUT must be .vtp or .vtk",
    )
    result.add_flag(
        "--uncertainty",
        "Add Uncertainty, the error bar of each vertex, in units of INPUT. OUTPUT must be .vtp or .vtk",
    )
    result.add_number(
        "--time-limit", "TimeLimit",
        f"Largest time of learning in seconds, {described('TimeLimit')}; the mesh learnt so far is written, "
        "with a warning; 0: no limit. A run that goes on from a checkpoint and has all its vertices is "
        "finished whatever the limit", "SECONDS",
    )  # fmt: skip
    result.add_flag(
        "--in-place",
        "Draw points from INPUT, which may be larger than the memory, instead of reading it. INPUT is a "
        "binary .ply or a .vtp with appended raw data",
    )
    result.add_choice(
        "--raw", ["float", "double"], None,
        "INPUT is x y z in binary, of 4 or 8 bytes each, little-endian. Draw points as with --in-place",
    )  # fmt: skip
    result.add_argument(
        "--skip",
        type=number_from(0, 2**63 - 1, True),
        default=0,
        metavar="BYTES",
        help="With --raw: bytes before the first point",
    )
    result.add_number(
        "--threads", "NumberOfThreads",
        f"Largest number of threads, {described('NumberOfThreads')}; 0: as many as the process may run "
        "at once; the mesh is the same with any number", "N",
    )  # fmt: skip
    result.add_text(
        "--statistics", "Write the learning curve to this .csv file", "FILE"
    )
    result.add_text(
        "--explain",
        "Write the points of INPUT to this .vtp file (by VTK), each with its Distance to the mesh and a "
        "Reason. This takes some seconds for millions of points",
        "FILE",
    )
    result.add_text(
        "--feature-lines",
        "Write edges sharper than FeatureAngle (30 degrees) that the points confirm to this .vtp or .vtk "
        "file (by VTK), as lines with corners. OUTPUT gets the array Crease",
        "FILE",
    )
    result.add_flag(
        "--strict", "Exit with status 3 if there was a warning. The mesh is written in any case"
    )
    result.add_text(
        "--checkpoint",
        "Save the state of the run to this file, and resume from it if it exists. The mesh is the same, "
        "byte for byte, however often the command was killed",
        "FILE",
    )
    interval = property_of("CheckpointInterval")
    result.add_argument(
        "--checkpoint-interval",
        type=number_from(interval.low, interval.high, False),
        metavar="SECONDS",
        help=f"Seconds between two checkpoints, {described('CheckpointInterval')}; "
        "with --checkpoint",
    )
    result.add_flag(
        "--dry-run", "Write nothing, and print estimates of the memory and the time of the run"
    )
    result.add_flag("--quiet", "Print only errors and warnings")
