# SPDX-License-Identifier: BSD-3-Clause
"""Does runs in a process of its own: python3 -m neuralmesh.lab.worker FOLDER, with a run a line.

Each is stored before the next one begins, and answered by a line: what went wrong, or nothing.
Threads are one for each process, so that CPU times are those of one core.
"""

from __future__ import annotations

import csv
import io
import json
import os
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable

from .._execution import execute
from .._reconstruct import make_filter
from .experiment import Run
from .measuring import measure
from .models import cloud_of
from .store import store_result

STEP_TIMES = Path(__file__).with_name("step-times")
_LABORATORY = os.getppid()
_MOMENTS = 60  # of a curve at most


def main(folder: Path) -> None:
    for line in sys.stdin:
        run = Run(**json.loads(line))
        try:
            with warnings.catch_warnings():
                # That a setting may not grow is for the figures to tell.
                warnings.simplefilter("ignore")
                figures, curve, mesh = _DO[run.kind](run)
            store_result(folder, run, figures, curve, mesh)
            answer = ""
        except Exception as error:  # whatever it is: the others go on
            answer = str(error) or type(error).__name__
        print(json.dumps(answer), flush=True)


_Result = tuple[dict[str, Any], dict[str, list[float]], vtkPolyData | None]


def _learn(run: Run) -> _Result:
    cloud = cloud_of(run.model, run.points)
    mesh_filter = make_filter(
        run.vertices, run.seed, **{"preset": "thesis", "number_of_threads": 1, **run.parameters}
    )
    mesh_filter.SetInputData(cloud)
    execute(mesh_filter, lambda _fraction: _end_with_laboratory())
    mesh = mesh_filter.GetAverageMesh() if run.kind == "average" else mesh_filter.GetOutput()
    if mesh.GetNumberOfPolys() == 0:
        raise ValueError(f"{run.model}: there is no mesh")
    fields = mesh_filter.GetOutput().GetFieldData()
    figures = {
        "vertices": mesh.GetNumberOfPoints(),
        "seconds": mesh_filter.GetLearningTime(),
        "stop": fields.GetAbstractArray("StopReason").GetValue(0),
    }
    if run.kind == "mesh":
        topology = {"genus": "Genus", "pieces": "Components", "openings": "BoundaryLoops"}
        figures |= {name: fields.GetArray(array).GetValue(0) for name, array in topology.items()}
        figures["folds"] = 100 * fields.GetArray("FoldedEdges").GetValue(0) / figures["vertices"]
    figures |= measure(mesh, run.model, run.points)
    curve = _curve(mesh_filter.GetLearningCurve(), figures["seconds"])
    return figures, curve, mesh if run.keeps_mesh else None


def _end_with_laboratory() -> None:
    """Without a result: half a run is none."""
    if os.getppid() != _LABORATORY:
        sys.exit("the laboratory has ended")


def _curve(table: vtkTable, seconds: float) -> dict[str, list[float]]:
    """What was so while the mesh grew; its clock is scaled to CPU time."""
    names = {"vertices": "Vertices", "seconds": "Seconds", "regular": "RegularRatio"}
    columns = {name: vtk_to_numpy(table.GetColumnByName(c)) for name, c in names.items()}
    # A mesh that shrinks now and then is shown as large as it has been.
    _, kept = np.unique(np.maximum.accumulate(columns["vertices"]), return_index=True)
    kept = kept[np.unique(np.linspace(0, len(kept) - 1, _MOMENTS).astype(int))]
    columns = {name: column[kept].astype(float) for name, column in columns.items()}
    columns["regular"] *= 100
    if columns["seconds"][-1] > 0:
        columns["seconds"] *= seconds / columns["seconds"][-1]
    return {name: column.tolist() for name, column in columns.items()}


def _time_steps(run: Run) -> _Result:
    """By the program that can search through all counters, which the filter does not offer."""
    with tempfile.NamedTemporaryFile(suffix=".raw") as file:
        points = vtk_to_numpy(cloud_of(run.model, run.points).GetPoints().GetData())
        points.astype("<f4").tofile(file)
        file.flush()
        options = [f"--{name.replace('_', '-')}" if value is True
                   else f"--{name.replace('_', '-')}={value}"
                   for name, value in run.parameters.items() if value is not False]  # fmt: skip
        command = [STEP_TIMES, file.name, f"--vertices={run.vertices}", f"--seed={run.seed}"]
        output = _output([*map(str, command), *options])
    rows = list(csv.DictReader(io.StringIO(output)))
    curve = {name: [float(row[name]) for row in rows] for name in rows[0]}
    steps = [name for name in curve if name.endswith("_seconds")]
    curve["seconds"] = np.sum([curve[name] for name in steps], axis=0).tolist()
    curve["regular"] = [100 * ratio for ratio in curve.pop("regular_ratio")]
    calls = {"basic": "iterations", "addition": "additions", "removal": "removed",
             "topology": "topology_calls"}  # fmt: skip
    figures = {name: curve[name][-1] for name in ("vertices", "seconds", "regular", *steps)}
    for step, count in calls.items():
        cost = 1e6 * curve[f"{step}_seconds"][-1] / max(1.0, curve[count][-1])
        figures[f"{step}_us"] = cost if curve[count][-1] else None
    return figures, curve, None


def _output(command: list[str]) -> str:
    """What the program prints; it ends when the laboratory has ended."""
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        while True:
            try:
                output, errors = process.communicate(timeout=0.1)
                break
            except subprocess.TimeoutExpired:
                if os.getppid() != _LABORATORY:
                    process.kill()
    _end_with_laboratory()
    if process.returncode != 0:
        raise RuntimeError(errors.strip() or f"step-times ended with status {process.returncode}")
    return output


_DO = {"mesh": _learn, "average": _learn, "steps": _time_steps}

if __name__ == "__main__":
    main(Path(sys.argv[1]))
