# SPDX-License-Identifier: BSD-3-Clause
"""The report next to each result, and the summary of all."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import math
import os
from pathlib import Path
from typing import Any

from .. import VTK_VERSION, __version__
from .._parameters import snake_case
from .meshes import fields_of
from .recipe import Job, Recipe, RecipeError
from .atomic_file import write_text
from .words import tags_of

PHASES = ("cloud", "start", "learning", "finish")
SECONDS = ("reading", "reconstruction", "writing")


def report_path(folder: Path, job_name: str) -> Path:
    return folder / f"{job_name}.json"


def result_path(folder: Path, job_name: str, mesh_format: str) -> Path:
    return folder / f"{job_name}.{mesh_format}"


def summary_path(folder: Path) -> Path:
    return folder / "summary.csv"


def require_distinct(recipe_path: Path, recipe: Recipe, folder: Path) -> None:
    """Raise RecipeError where what a job writes is a scan, a first mesh, or the recipe itself."""
    written = {"the summary": summary_path(folder), "the gallery": folder / "index.html"}
    for job in recipe.jobs:
        written[f"the mesh of {job.name}"] = result_path(folder, job.name, recipe.format)
        written[f"the report on {job.name}"] = report_path(folder, job.name)
        for level in job.smaller_levels:
            name = job.level_name(level)
            written[f"the mesh of {name}"] = result_path(folder, name, recipe.format)
    places = {os.path.realpath(path): what for what, path in written.items()}
    for path in [recipe_path, *(path for job in recipe.jobs for path in (job.scan, job.first_mesh))]:
        if path is not None and os.path.realpath(path) in places:
            what = places[os.path.realpath(path)]
            raise RecipeError(f"{path}: {what} would be written there; choose another folder")


def checkpoint_path(folder: Path, job_name: str, identity: dict[str, Any]) -> Path:
    """Where a job leaves its state while it lasts: another file for another identity."""
    digest = hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()
    return folder / f".{job_name}.{digest[:16]}.checkpoint"


def identity_of(job: Job, mesh_format: str) -> dict[str, Any]:
    """What the result depends on."""
    first_mesh = {"first_mesh": _identity_of_file(job.first_mesh)} if job.first_mesh else {}
    return {
        "scan": _identity_of_file(job.scan),
        **first_mesh,
        "shift": job.shift,
        "parameters": job.parameters,
        "format": mesh_format,
        "version": __version__,
        "vtk_version": VTK_VERSION,
    }


def _identity_of_file(path: Path) -> dict[str, Any]:
    """A file is known by its path, size and time of modification."""
    try:
        status = path.stat()
    except OSError:
        return {"path": str(path)}
    return {"path": str(path), "size": status.st_size, "mtime_ns": status.st_mtime_ns}


def read_report(folder: Path, job_name: str) -> dict[str, Any]:
    """The report on a job; empty if there is none."""
    try:
        content = json.loads(report_path(folder, job_name).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return content if isinstance(content, dict) else {}


def is_done(folder: Path, job: Job, mesh_format: str) -> bool:
    """Whether the result is there, whole, and of the same scan, parameters, format and version."""
    report = read_report(folder, job.name)
    identity = identity_of(job, mesh_format)
    is_same = all(report.get(name) == value for name, value in identity.items())
    if report.get("status") != "done" or not is_same:
        return False
    results = [report["result"], *(level["result"] for level in report.get("levels", []))]
    return all(_is_whole(folder / result["file"], result["size"]) for result in results)


def _is_whole(path: Path, size: int) -> bool:
    return path.is_file() and path.stat().st_size == size


def warnings_of(folder: Path, job: Job) -> list[str]:
    """What there was to warn of, when the job was done."""
    return read_report(folder, job.name).get("warnings", [])


def quality_of(mesh) -> dict[str, Any]:
    """The field data of the mesh: how the run went, and how good the mesh is."""
    # The report has the warnings by themselves.
    return {
        snake_case(name): _plain(value)
        for name, value in fields_of(mesh).items()
        if name != "Warnings"
    }


def _plain(value: Any) -> Any:
    """The value as JSON knows it: no NaN."""
    return None if isinstance(value, float) and not math.isfinite(value) else value


def write_summary(folder: Path, recipe: Recipe) -> None:
    """Write summary.csv, a row for each job. What there is no figure for, is empty."""
    rows = [_row(job, read_report(folder, job.name), recipe) for job in recipe.jobs]
    columns: dict[str, None] = {}
    for row in rows:
        columns.update(dict.fromkeys(row))
    # The error stands last, as it is long.
    names = [name for name in columns if name != "error"] + ["error"]
    text = io.StringIO()
    writer = csv.DictWriter(text, names, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(summary_path(folder), text.getvalue())


def _row(job: Job, report: dict[str, Any], recipe: Recipe) -> dict[str, Any]:
    result = report.get("result", {})
    # The parameters have columns of their own, before these.
    quality = {
        name: value
        for name, value in report.get("quality", {}).items()
        if name not in job.parameters
    }
    return {
        "job": job.name,
        "scan": str(job.scan),
        **{name: job.parameters[name] for name in recipe.parameter_names},
        "status": report.get("status", "missing"),
        "result": result.get("file", ""),
        "points": result.get("points", ""),
        "triangles": result.get("triangles", ""),
        "warnings": tags_of(report.get("warnings", [])),
        **{f"{name}_seconds": report.get("seconds", {}).get(name, "") for name in SECONDS},
        **{f"{name}_cpu_seconds": report.get("phases", {}).get(name, "") for name in PHASES},
        **quality,
        "error": report.get("error", ""),
    }
