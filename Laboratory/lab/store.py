# SPDX-License-Identifier: BSD-3-Clause
"""Results of runs, each in a file of its own by the key of its run: what need not be done again."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ..batch.atomic_file import atomic_file, write_json
from .experiment import Case, Run
from .measuring import arrays_of
from .models import model_name
from .table import Table


def _result_path(folder: Path, run: Run) -> Path:
    return folder / f"{run.key}.json"


def mesh_path(folder: Path, key: str) -> Path:
    return folder / f"{key}.npz"


def store_result(
    folder: Path,
    run: Run,
    figures: dict[str, Any],
    curve: dict[str, list[float]],
    mesh: vtkPolyData | None,
) -> None:
    """Store what came out: the mesh first, so that no result lacks it."""
    if mesh is not None:
        points, triangles = arrays_of(mesh)
        with atomic_file(mesh_path(folder, run.key)) as path:
            np.savez(path, points=points.astype("f4"), triangles=triangles.astype("i4"))
    write_json(
        _result_path(folder, run), {"run": run.content(), "figures": figures, "curve": curve}
    )


def is_done(folder: Path, run: Run) -> bool:
    return bool(_result(folder, run))


def _result(folder: Path, run: Run) -> dict[str, Any]:
    """What is stored of a run; nothing if that is not whole, or is of something else."""
    try:
        content = json.loads(_result_path(folder, run).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    is_same = isinstance(content, dict) and content.get("run") == run.content()
    has_mesh = not run.keeps_mesh or mesh_path(folder, run.key).is_file()
    return content if is_same and has_mesh else {}


def table_of(folder: Path, cases: list[Case]) -> Table:
    """A row for each case whose run is done."""
    rows = []
    for case in cases:
        result = _result(folder, case.run)
        if result:
            start = {"model": model_name(case.run.model), **case.factors, "seed": case.run.seed}
            mesh = str(mesh_path(folder, case.run.key)) if case.run.keeps_mesh else None
            row = {**start, **result["figures"], "curve": result["curve"], "mesh_file": mesh}
            rows.append(row)
    return Table(rows)


def read_stored_mesh(path: str) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles."""
    with np.load(path) as arrays:
        return arrays["points"], arrays["triangles"]
