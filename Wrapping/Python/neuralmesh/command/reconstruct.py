# SPDX-License-Identifier: BSD-3-Clause
"""The subcommand reconstruct."""

from __future__ import annotations

import argparse
import contextlib
import os
import signal
import sys
import threading
import time
from typing import Any, Iterator, Sequence

import numpy as np

from .. import _engine
from ..engine import files
from ..engine.cloud import as_cloud
from ..engine.mesh import Mesh
from ..engine.reconstruction import NeuralMesh, NeuralMeshEnsemble, Outcome
from . import settings
from .estimate import print_estimate
from .inputs import read_inputs
from .names import (
    NamedFile, read_mesh, read_points, require_distinct, require_explanation, require_lines,
    require_output, told_warnings,
)  # fmt: skip
from .parsing import UsageError, three_numbers, words_of
from .progress_bar import ProgressBar
from .reconstruct_options import parser
from .run_report import Drawn, Seconds, print_lines, print_run

_WARNED = 3  # the exit status with --strict, if there was a warning
_OF_SIGNALS = 128  # and the number of the signal that has ended the learning


def run(arguments: Sequence[str]) -> int:
    """Make a triangle mesh from a point cloud; the exit status."""
    told_warnings.clear()
    options = parser().parse(arguments)
    options.inputs, options.output = _names(options)
    mesh = _filter_of(options)
    _require_sound_size(options, mesh)
    shift = _shift_of(options.shift)
    if options.remesh:
        _prepare_remeshing(options, mesh)
    _require_sound_files(options, mesh)

    watch = [time.monotonic()]
    drawn = _draw(options, mesh) if options.in_place or options.raw is not None else None
    points = drawn.points if drawn else _read(options, mesh)
    first = read_mesh(options.initial) if options.initial else None
    files.require_digits(
        points.points, mesh.most_vertices(len(points.points)), options.output, shift
    )
    watch.append(time.monotonic())
    if options.dry_run:
        print_estimate(mesh, points, first, _names_in_errors(options))
        return 0

    mesh.SetCheckpointFileName(options.checkpoint)
    mesh.SetCheckpointInterval(options.checkpoint_interval)
    mesh.KeepCheckpointOn()  # until the mesh is written
    with _interruption() as is_interrupted:
        outcome = _learn(mesh, points, first, options, is_interrupted)
        watch.append(time.monotonic())
        stored = files.write_mesh(outcome.mesh, options.output, shift)
        if options.statistics:
            _engine.write_whole(options.statistics, _table_of(outcome.curve))
        # A run that was ended early has explained nothing.
        if outcome.explained is not None and len(outcome.explained.points) > 0:
            files.write_mesh(outcome.explained, options.explain)
        if outcome.feature_lines is not None:
            _write_lines(outcome.feature_lines, options.feature_lines)
        for level, path in zip(outcome.smaller_levels, _level_paths(options)):
            files.write_mesh(level, path, shift)
        watch.append(time.monotonic())
    reason = mesh.GetStopReason()
    if reason not in ("cancelled", "time limit"):
        mesh.RemoveCheckpoint()
    if not options.quiet:
        seconds = Seconds(*(after - before for before, after in zip(watch, watch[1:])))
        print_run(mesh, outcome.mesh, points, drawn, seconds)
        if outcome.feature_lines is not None:
            print_lines(outcome.feature_lines)
        for level, path in zip(outcome.smaller_levels, _level_paths(options)):
            residual = level.field_data["Residual"]
            print(f"level      {len(level.points)} vertices, residual {residual:.3g}: {path}")
        if options.shift:
            _print_shift(stored, options.output)
    if reason == "cancelled":
        return _OF_SIGNALS + (is_interrupted() or signal.SIGINT)
    return _WARNED if options.strict and (told_warnings or outcome.warnings) else 0


def _require_sound_size(options: argparse.Namespace, mesh: Any) -> None:
    """UsageError where a number of vertices that is to be found excludes something else."""
    if not mesh.is_size_to_be_found():
        return
    problem = mesh.why_no_size(
        bool(options.initial or options.ensemble), bool(options.checkpoint)
    )
    if problem:
        raise UsageError(f"{'--tolerance' if options.tolerance else '--vertices auto'}: {problem}")
    if options.dry_run:
        raise UsageError(
            "--dry-run: the program estimates a run only for a given number of vertices"
        )


def _names(options: argparse.Namespace) -> tuple[list[str], str]:
    """The last of all names is OUTPUT."""
    *inputs, output = options.files
    if len(inputs) > 1 and files.extension_of(output) not in files.WRITABLE:
        raise UsageError(
            f"{output}: this is the last of several files, so it is OUTPUT; but it has no extension "
            "of a mesh"
        )
    return inputs, output


def _level_paths(options: argparse.Namespace) -> list[str]:
    """The files of all levels but the largest, which is OUTPUT itself."""
    stem, extension = os.path.splitext(options.output)
    return [f"{stem}_{level}{extension}" for level in (options.levels or [])[:-1]]


def _write_lines(lines: Any, path: str) -> None:
    if lines.lines:
        files.write_mesh(lines, path)
    else:
        # On stderr, whatever else is said: a file of that name may be of another run.
        print(
            f"neuralmesh: there are no feature lines, so {path} is not written", file=sys.stderr
        )


def _filter_of(options: argparse.Namespace) -> Any:
    mesh: Any = NeuralMesh()
    if options.ensemble:
        mesh = NeuralMeshEnsemble()
        mesh.SetNumberOfMembers(options.ensemble)
    mesh.SetNumberOfVertices(options.vertices)
    for level in options.levels or []:
        mesh.AddLevel(level)
    if options.tolerance is not None:
        length, is_percent = options.tolerance
        mesh.SetTolerance(length)
        mesh.SetToleranceIsPercent(is_percent)
        mesh.SetToleranceMeasure(options.tolerance_of)
    mesh.SetSeed(options.seed)
    mesh.SetVariant(options.method)
    mesh.SetOrder(options.order)
    if options.topology is not None:
        mesh.SetTopologyLearning(options.topology)
    mesh.SetBoundaries(options.boundaries)
    mesh.SetCloseHolesBelow(options.close_holes_below)
    mesh.SetFidelity(options.fidelity)
    mesh.SetKeepPieces(options.keep_pieces)
    mesh.SetComputeFeatureStrength(options.features)
    mesh.SetComputeUncertainty(options.uncertainty)
    mesh.SetPreset(options.preset)
    mesh.SetAutomatic(options.automatic)
    mesh.SetExplainPoints(bool(options.explain))
    mesh.SetComputeFeatureLines(bool(options.feature_lines))
    mesh.SetTimeLimit(options.time_limit)
    mesh.SetNumberOfThreads(options.threads)
    mesh.SetWeightArrayName(options.weights)
    _tell_sides(mesh, options)
    if options.jump:
        _set_jump(mesh, options.jump)
    for assignment in options.set:
        settings.set_parameter(mesh, assignment)
    problems = mesh.parameter_errors()
    if problems:
        raise UsageError(problems[0])
    return mesh


def _prepare_remeshing(options: argparse.Namespace, mesh: Any) -> None:
    """UsageError if that does not go with what else is asked for."""
    problem = mesh.remeshing_error(
        {
            "points": options.in_place or options.raw is not None,
            "first_mesh": bool(options.initial),
            "sides": bool(options.views),
            "checkpoint": bool(options.checkpoint),
            "estimate": options.dry_run,
        }
    )
    if problem:
        raise UsageError(f"--remesh: {problem}")
    if len(options.inputs) > 1:
        raise UsageError("--remesh: this goes with one INPUT only")
    mesh.SetInputIsToSurface()


def _tell_sides(mesh: Any, options: argparse.Namespace) -> None:
    for text in options.viewpoint:
        mesh.AddViewpoint(_place("--viewpoint", text))
    if options.up:
        up = _place("--up", options.up)
        if not any(up):
            raise UsageError(f"--up: {options.up} is no direction")
        mesh.SetUpDirection(up)
    if options.view_array and not options.views and not options.viewpoint:
        raise UsageError("--view-array: this goes with --views or --viewpoint only")
    mesh.SetViewArrayName(options.view_array)
    if options.normals == "off":
        mesh.UseNormalsOff()
    else:
        mesh.SetNormalArrayName(options.normals)
    if options.views:
        places = read_points(options.views).points
        if len(places) == 0:
            raise ValueError(f"{options.views}: there are no places in it")
        for place in places:
            mesh.AddViewpoint(place)


def _place(option: str, text: str) -> tuple[float, float, float]:
    place = three_numbers(text)
    if place is None:
        raise UsageError(f"{option}: {text} is not X,Y,Z: three numbers, as 0.5,0,12")
    return place


def _set_jump(mesh: Any, text: str) -> None:
    name, equals, fraction = text.partition("=")
    words = words_of("Jump")
    if name not in words:
        raise UsageError(f"--jump: {name} is none of {'|'.join(words)}")
    mesh.SetJump(words.index(name))
    if equals:
        settings.set_parameter(mesh, f"JumpFraction={fraction}")


def _shift_of(text: str) -> tuple[float, float, float] | str | None:
    if text in ("", "auto"):
        return text or None
    vector = three_numbers(text)
    if vector is None:
        raise UsageError(f"--shift: {text} is neither auto nor X,Y,Z")
    return vector


def _require_sound_files(options: argparse.Namespace, mesh: Any) -> None:
    require_distinct(
        [
            NamedFile("--initial", options.initial),
            NamedFile("--views", options.views),
            *(NamedFile("INPUT", path) for path in options.inputs),
            NamedFile("OUTPUT", options.output, True),
            NamedFile("--statistics", options.statistics, True),
            NamedFile("--explain", options.explain, True),
            NamedFile("--feature-lines", options.feature_lines, True),
            NamedFile("--checkpoint", options.checkpoint, True),
            *(NamedFile("--levels", path, True) for path in _level_paths(options)),
        ]
    )
    require_output(options.output)
    keeps_arrays = files.extension_of(options.output) in (".vtp", ".vtk")
    for name, is_wanted in (("--features", options.features), ("--uncertainty", options.uncertainty)):
        if is_wanted and not keeps_arrays:
            raise UsageError(
                f"{name}: {options.output} must be a .vtp or .vtk; no other format keeps it"
            )
    _engine.require_place(options.output)
    if options.statistics:
        if files.extension_of(options.statistics) != ".csv":
            raise ValueError(f"{options.statistics}: unknown extension; writable is .csv")
        _engine.require_place(options.statistics)
    if options.explain:
        require_explanation("--explain", options.explain)
    if options.feature_lines:
        require_lines("--feature-lines", options.feature_lines)
    if options.checkpoint:
        _engine.require_place(options.checkpoint)
    if options.skip > 0 and options.raw is None:
        raise UsageError("--skip: this goes with --raw only")
    if (options.in_place or options.raw is not None) and len(options.inputs) > 1:
        option = "--in-place" if options.raw is None else "--raw"
        raise UsageError(f"{option}: this goes with one INPUT only")


def _read(options: argparse.Namespace, mesh: Any) -> Mesh:
    if options.remesh:
        return read_mesh(options.inputs[0])
    return read_inputs(options.inputs, mesh.GetNumberOfViewpoints(), options.view_array)


def _draw(options: argparse.Namespace, mesh: Any) -> Drawn:
    found = _engine.draw_points(
        options.inputs[0],
        mesh.GetUsedMaximumPoints(),
        options.seed,
        None,
        "" if options.raw is None else ("float", "double")[options.raw],
        options.skip,
    )
    points = Mesh(found["points"], np.empty((0, 3), dtype=np.int64))
    if "RGB" in found:
        points.point_data["RGB"] = found["RGB"]
        points.scalars = "RGB"
    if "normals" in found:
        points.point_data["Normals"] = found["normals"]
    return Drawn(points, found["file_points"], found["seconds"])


def _learn(
    mesh: Any, points: Mesh, first: Mesh | None, options: argparse.Namespace, is_interrupted: Any
) -> Outcome:
    bar = ProgressBar(options.vertices)

    def tell(fraction: float) -> bool:
        if not options.quiet:
            bar.show(fraction)
        return not is_interrupted()

    try:
        outcome = mesh.run(as_cloud(points), first, tell)
    except ValueError as error:
        raise ValueError(f"{_names_in_errors(options)}: {error}") from None
    finally:
        bar.clear()
    for warning in outcome.warnings:
        print(f"neuralmesh: warning: {warning}", file=sys.stderr)
    if len(outcome.mesh.points) == 0:
        raise ValueError(f"{', '.join(options.inputs)}: there are no points in it")
    return outcome


def _names_in_errors(options: argparse.Namespace) -> str:
    first = f" (first mesh {options.initial})" if options.initial else ""
    return ", ".join(options.inputs) + first


@contextlib.contextmanager
def _interruption() -> Iterator[Any]:
    """Meanwhile Ctrl-C is only noted, and so is what asks to end, as SIGTERM; tells the signal, or 0."""
    noted = 0

    def note(number: int, _frame: Any) -> None:
        nonlocal noted
        noted = number

    before: dict[int, Any] = {}
    # Of signals only the main thread hears.
    if threading.current_thread() is threading.main_thread():
        for number in (signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)):
            # What runs under nohup goes on when its terminal is closed.
            if number == signal.SIGINT or signal.getsignal(number) != signal.SIG_IGN:
                before.setdefault(number, signal.signal(number, note))
    try:
        yield lambda: noted
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _table_of(curve: dict[str, np.ndarray]) -> bytes:
    """The learning curve as .csv, with six digits."""
    lines = [",".join(f'"{name}"' for name in curve)]
    for row in zip(*curve.values()):
        lines.append(
            ",".join(f"{one:.6g}" if one.dtype.kind == "f" else str(int(one)) for one in row)
        )
    return ("\n".join(lines) + "\n").encode()


def _print_shift(shift: tuple[float, float, float], path: str) -> None:
    if not any(shift):
        print("shift      none")
        return
    _, _, numbers = _engine.shift_note(shift).partition(" ")
    print(f"shift      {numbers}, to be added to the coordinates of {path}")
