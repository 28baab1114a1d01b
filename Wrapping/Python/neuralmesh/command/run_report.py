# SPDX-License-Identifier: BSD-3-Clause
"""The printed report of a run."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import Any

from .._sides import sides_text
from ..engine.mesh import Mesh


@dataclass
class Seconds:
    """Wall-clock times."""

    reading: float
    learning: float
    writing: float


@dataclass
class Drawn:
    """Points that were drawn from a file where they lie."""

    points: Mesh
    file_points: int
    seconds: float


def print_run(run: Any, mesh: Mesh, points: Mesh, drawn: Drawn | None, seconds: Seconds) -> None:
    """How the run went, and what the mesh is worth."""
    fields = mesh.field_data
    _print_points(points, drawn, fields)
    print(f"vertices   {len(mesh.points)}")
    print(f"triangles  {len(mesh.triangles)}")
    print(f"samples    {fields['Iterations']}, ended by: {run.GetStopReason()}")
    _print_checkpoint(run)
    _print_phases(run, drawn)
    whole = seconds.reading + seconds.learning + seconds.writing
    print(
        f"time       {whole:.2f} s (reading {seconds.reading:.2f}, learning {seconds.learning:.2f}, "
        f"writing {seconds.writing:.2f})"
    )
    _print_sides(fields)
    _print_quality(fields)
    _print_choices(fields)
    for number, reason in enumerate(fields.get("Choice", ())):
        print(f"{'' if number else 'how many':10} {reason}")


def print_reasons(fields: dict[str, Any]) -> None:
    """How many points were left out, and why."""
    print(
        f"left out   {fields['OutlierPoints']} outliers, {fields['SmallPiecePoints']} in small pieces, "
        f"{fields['UnreachablePoints']} unreachable: {100.0 * fields['UnexplainedShare']:.2g} % "
        "unexplained"
    )


def print_lines(lines: Mesh) -> None:
    """How many feature lines there are, and how long they are, if there are some."""
    if not lines.lines:
        return
    corners = 0 if lines.corners is None else len(lines.corners)
    print(
        f"lines      {len(lines.lines)} of the length {sum(lines.cell_data['Length']):.4g}, with "
        f"{corners} corners"
    )


def _print_points(points: Mesh, drawn: Drawn | None, fields: dict[str, Any]) -> None:
    count, dropped = len(points.points), fields["DroppedPoints"]
    if drawn:
        print(f"points     {drawn.file_points} ({count} drawn, {dropped} of them dropped)")
    else:
        print(f"points     {count} ({dropped} dropped)")
    missing = points.field_data.get("MissingReturns")
    if missing:
        print(f"no return  {missing} directions in which the scanner saw nothing")


def _print_checkpoint(run: Any) -> None:
    """Where the run went on from, and where it may go on."""
    path = run.GetCheckpointFileName()
    if run.GetResumedIterations() > 0:
        print(f"resumed    at sample {run.GetResumedIterations()}, from {path}")
    if path and os.path.exists(path):
        more = ", with more time" if run.GetStopReason() == "time limit" else ""
        print(f"checkpoint {path}: the same command goes on from there{more}")


def _print_phases(run: Any, drawn: Drawn | None) -> None:
    phases = {
        "cloud": run.GetCloudTime(),
        "start": run.GetStartTime(),
        "learning": run.GetLearningTime(),
        "finish": run.GetFinishTime(),
    }
    choice, drawing = run.GetChoiceTime(), drawn.seconds if drawn else 0.0
    whole = drawing + choice + sum(phases.values())
    parts = [f"drawing {drawing:.2f}"] if drawn else []
    parts += [f"choice {choice:.2f}"] if choice > 0 else []
    parts += [f"{name} {value:.2f}" for name, value in phases.items()]
    print(f"phases     {whole:.2f} CPU s ({', '.join(parts)})")


def _print_sides(fields: dict[str, Any]) -> None:
    text = sides_text(fields["OrientedBy"], fields["UnorientedShare"], fields["GuessedShare"])
    print(f"sides      {text}")


def _print_quality(fields: dict[str, Any]) -> None:
    """Nothing of a run that was aborted."""
    if "Residual" not in fields:
        return
    noise, shared = fields["Noise"], fields["SharedNoise"]
    print(
        f"residual   {fields['Residual']:.3g} from held-out points to the mesh"
        + (f", noise about {noise:.3g}" if math.isfinite(noise) else "")
        + (f" (shared {shared:.3g})" if shared > 0 else "")
        + f", {100.0 * fields['OutlierShare']:.2g} % too far off to count"
    )
    if "UnexplainedShare" in fields:  # a surface has no points to be left out
        print_reasons(fields)
    rounds = fields["FitRoundsTakenBack"]
    if rounds > 0:
        taken = _counted(rounds, "round", "rounds")
        print(f"fit        {taken} taken back: with more of it the mesh was worse than before")
    genus, cutting = fields["Genus"], fields["IntersectingTriangles"]
    parts = [
        _counted(fields["Components"], "piece", "pieces"),
        "genus not defined" if genus < 0 else _counted(genus, "handle", "handles"),
        _counted(fields["BoundaryLoops"], "boundary", "boundaries"),
        _counted(fields["FoldedEdges"], "folded edge", "folded edges"),
        (
            "intersections not looked for"
            if cutting < 0
            else _counted(cutting, "intersecting triangle", "intersecting triangles")
        ),
    ]
    print(f"shape      {', '.join(parts)}")
    print(
        f"quality    {fields['TriangleQuality']:.3f} of the triangles on average (1: equilateral), "
        f"{100.0 * fields['RegularRatio']:.0f} % of the vertices regular"
    )


def _print_choices(fields: dict[str, Any]) -> None:
    """Which parameters were chosen for the cloud, if any were to be."""
    if "ChosenParameters" not in fields:
        return
    print(f"chosen     {', '.join(fields['ChosenParameters']) or 'the defaults'}")
    for reason in fields.get("ReasonsOfChoice", ()):
        print(f"           {reason}")


def _counted(count: int, one: str, several: str) -> str:
    return f"no {several}" if count == 0 else f"{count} {one if count == 1 else several}"
