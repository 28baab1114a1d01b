# SPDX-License-Identifier: BSD-3-Clause
"""One job in a process of its own: python3 -m neuralmesh.batch.job, with the job on its input.

Writes the result and, after it, the report, so that a report of success never lacks its result.
What goes wrong is said in one message on the standard error, and the exit status is 1.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import time
import warnings
from pathlib import Path
from typing import Any, Iterator

from .. import _world
from .._command import words_of
from .._reconstruct import make_filter, require_points, take_input
from .meshes import counts_of, read_mesh, read_points, require_digits, write_mesh
from .report import (
    PHASES,
    SECONDS,
    checkpoint_path,
    identity_of,
    quality_of,
    report_path,
    result_path,
)
from .recipe import Job
from .atomic_file import WriteError, write_json


def main() -> None:
    content = json.load(sys.stdin)
    first_mesh = content["first_mesh"] and Path(content["first_mesh"])
    scan, parameters = Path(content["scan"]), content["parameters"]
    job = Job(content["name"], scan, parameters, first_mesh, content["shift"])
    try:
        run(job, Path(content["folder"]), content["format"])
    except WriteError as error:  # which names the file
        sys.exit(str(error))
    except Exception as error:  # whatever it is: it goes into the report
        text = words_of(error)
        # Some readers name the file, with the line where it is wrong.
        sys.exit(text if text.startswith(str(job.scan)) else f"{job.scan}: {text}")


def _has_checkpoint(mesh_filter: Any) -> bool:
    """Whether the run can have a checkpoint: it learns a cloud, with one number of vertices."""
    return not (
        _is_size_to_be_found(mesh_filter)
        or mesh_filter.GetNumberOfLevels() > 0
        or mesh_filter.GetInputIs()
    )


def _is_size_to_be_found(mesh_filter: Any) -> bool:
    return bool(mesh_filter.GetTolerance() > 0 or mesh_filter.GetNumberOfVertices() == 0)


def run(job: Job, folder: Path, mesh_format: str) -> None:
    # Before the scan is read: if it changes meanwhile, the job is not done.
    identity = identity_of(job, mesh_format)
    parameters = dict(job.parameters)
    weights = parameters.pop("weights", None)
    parameters.pop("first_mesh", None)
    times = [time.perf_counter()]
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        points = read_points(job.scan)
        first_mesh = read_mesh(job.first_mesh) if job.first_mesh else None
        times.append(time.perf_counter())
        mesh_filter = make_filter(**parameters)
        # If it is there, the job was killed: it goes on from there.
        if _has_checkpoint(mesh_filter):
            mesh_filter.SetCheckpointFileName(str(checkpoint_path(folder, job.name, identity)))
            mesh_filter.KeepCheckpointOn()
        cloud = take_input(mesh_filter, points, weights)
        path = result_path(folder, job.name, mesh_format)
        levels = parameters.get("levels")
        most = levels[-1] if levels else mesh_filter.GetNumberOfVertices()
        if _is_size_to_be_found(mesh_filter):
            most = max(4, counts_of(points)[0] // 2)
        require_digits(points, most, path, job.shift)
        mesh, _, _, smaller = _world.learn(
            mesh_filter, cloud, first_mesh, _end_with(os.getppid()), points
        )
        require_points(mesh)
    times.append(time.perf_counter())
    with _checkpoint_until_written(mesh_filter):
        shift = write_mesh(mesh, path, job.shift)
        paths = [result_path(folder, job.level_name(level), mesh_format) for level in job.smaller_levels]
        for level, level_path in zip(smaller, paths):
            write_mesh(level, level_path, job.shift)
        times.append(time.perf_counter())
        seconds = (round(after - before, 4) for before, after in zip(times, times[1:]))
        levels_told = [
            {"result": _file_of(level, level_path), "quality": quality_of(level)}
            for level, level_path in zip(smaller, paths)
        ]
        report: dict[str, Any] = {
            "job": job.name,
            "status": "done",
            **identity,
            "result": {
                **_file_of(mesh, path),
                "points": counts_of(points)[0],
                **({} if job.shift is None else {"shift": shift}),
            },
            **({"levels": levels_told} if levels_told else {}),
            "seconds": dict(zip(SECONDS, seconds)),
            "phases": {
                name: round(getattr(mesh_filter, f"Get{name.title()}Time")(), 4) for name in PHASES
            },
            "quality": quality_of(mesh),
            "warnings": [str(warning.message) for warning in warned],
        }
        write_json(report_path(folder, job.name), report)


@contextlib.contextmanager
def _checkpoint_until_written(mesh_filter: Any) -> Iterator[None]:
    """Remove the checkpoint when all is written, and when it cannot be: others need the room then."""
    try:
        yield
    except WriteError:
        mesh_filter.RemoveCheckpoint()
        raise
    mesh_filter.RemoveCheckpoint()


def _file_of(mesh: Any, path: Path) -> dict[str, Any]:
    """What a report says of a mesh that is written."""
    vertices, triangles = counts_of(mesh)
    return {
        "file": path.name,
        "size": path.stat().st_size,
        "vertices": vertices,
        "triangles": triangles,
    }


def _end_with(parent: int):
    """A function of progress that ends this process when the one that started it is gone."""

    def progress(_fraction: float) -> None:
        if os.getppid() != parent:
            sys.exit("the batch has ended")

    return progress


if __name__ == "__main__":
    main()
