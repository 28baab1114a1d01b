# SPDX-License-Identifier: BSD-3-Clause
"""What a run will take, roughly: --dry-run."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from .. import _engine
from ..engine.cloud import as_cloud
from ..engine.mesh import Mesh

_ANY_NUMBER = 2**62


def print_estimate(mesh: Any, points: Mesh, first: Mesh | None, names: str) -> None:
    """Learn a small mesh, or somewhat more of the first one, begin the run itself if it starts from the
    points, and tell what the whole run will take."""
    plan = plan_of(mesh, points)
    start, processor_start = time.monotonic(), time.process_time()
    try:
        trials = _trials(mesh, points, first, plan, names)
        seconds, used = time.monotonic() - start, time.process_time() - processor_start
        report = _engine.estimate(plan, *trials, seconds / max(used, 1e-3))
    except MemoryError:
        report = _engine.estimate(plan, {}, {}, 1.0)
        report += "time       not known: there is not enough memory to try it\n"
    print(f"points     {len(points.points)}")
    print(f"vertices   {int(plan['vertices'])}")
    print(report, end="")


def plan_of(mesh: Any, points: Mesh) -> dict[str, Any]:
    """The plan of a run, as far as it is known beforehand."""
    vertices = mesh.GetNumberOfVertices()
    arrays = [points.points, *(np.asarray(one) for one in points.point_data.values())]
    return {
        "vertices": float(vertices),
        "points": float(len(points.points)),
        "bytes_of_points": float(sum(one.nbytes for one in arrays)),
        "samples_for_features": (
            float(mesh.GetFeatureSamples() * vertices) if mesh.GetComputeFeatureStrength() else 0.0
        ),
        "samples_per_addition": float(mesh.GetSamplesPerAddition()),
        "most_samples": float(mesh.GetMaximumIterations()),
        "is_ensemble": bool(mesh.IS_ENSEMBLE),
    }


def _trials(
    mesh: Any, points: Mesh, first: Mesh | None, plan: dict[str, Any], names: str
) -> tuple[dict[str, Any], dict[str, Any]]:
    """The small mesh, and the beginning of the run, which may be empty."""

    def tried(vertices: int, samples: int) -> dict[str, Any]:
        mesh.SetNumberOfVertices(vertices)
        mesh.SetMaximumIterations(samples)
        return _tried(mesh, points, first, names)

    vertices = mesh.GetNumberOfVertices()
    most = (0 if first is None else len(first.points)) + _engine.tried_vertices
    mesh.SetTimeLimit(0.0)
    mesh.ComputeFeatureStrengthOff()
    if vertices <= most:
        return tried(vertices, mesh.GetMaximumIterations()), {}
    # With a rule that may end it a run is not made again with more vertices, of which its curve would tell.
    trial = tried(most, _ANY_NUMBER)
    learnt = _engine.learnt_vertices(plan) if mesh.GetFitRounds() > 0 else vertices
    starts_from_points = first is None and not mesh.IS_ENSEMBLE and mesh.GetStart() == 0
    if not starts_from_points or learnt <= most:
        return trial, {}
    mesh.AutomaticOff()
    mesh.ComputeUncertaintyOff()
    mesh.SetFitRounds(0)
    samples = _engine.tried_additions * mesh.GetSamplesPerAddition()
    return trial, tried(int(min(learnt, _engine.most_tried_start)), samples)


def _tried(mesh: Any, points: Mesh, first: Mesh | None, names: str) -> dict[str, Any]:
    try:
        outcome = mesh.run(as_cloud(points), first)
    except ValueError as error:
        raise ValueError(f"{names}: {error}") from None
    if len(outcome.mesh.points) == 0:
        raise ValueError(f"{names}: there are no points in it")
    columns = [outcome.curve[name] for name in ("Iteration", "Vertices", "Seconds")]
    return {
        "vertices": float(mesh.GetNumberOfVertices()),
        "growth": np.ascontiguousarray(np.stack(columns, axis=1), dtype=np.float64),
        "cloud_time": mesh.GetCloudTime() + mesh.GetChoiceTime(),
        "start_time": mesh.GetStartTime(),
        "learning_time": mesh.GetLearningTime(),
        "finish_time": mesh.GetFinishTime(),
    }
